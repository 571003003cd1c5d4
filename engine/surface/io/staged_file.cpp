// SPDX-License-Identifier: GPL-3.0-or-later
// Two runs, or two threads of one, may write the same path under names of their own aside; the last to finish
// wins.
#include "engine/surface/io/staged_file.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/part_file.hpp"
#include "engine/surface/io/source_file.hpp"

namespace asperity {

StagedFile::StagedFile(std::string path) : path_(std::move(path)) {
  namespace fs = std::filesystem;
  const fs::path whole(path_);
  const fs::path directory = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
  std::error_code failure;
  if (!fs::is_directory(directory, failure))
    throw Error(ErrorCode::bad_file,
                "there is no directory " + file_name(directory.string()) + " to write in", "make it first");
  if (fs::is_directory(whole, failure) || !whole.has_filename())
    throw Error(ErrorCode::bad_file, file_name(path_) + " is a directory", "give the name of a file in it");
  // A rename would put the file in the place of a device.
  if (fs::is_other(whole, failure))
    throw Error(ErrorCode::bad_file, file_name(path_) + " is not a plain file", "give the name of one");
  aside_ = part_beside(whole).string();
}

StagedFile::~StagedFile() {
  if (committed_) return;
  stream_.close();
  std::error_code failure;
  std::filesystem::remove(aside_, failure);
}

void StagedFile::write(std::string_view bytes) {
  if (!stream_.is_open()) stream_.open(aside_, std::ios::binary | std::ios::trunc);
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_)
    throw Error(ErrorCode::bad_file, file_name(path_) + " cannot be written",
                "check permission and space on the disk");
}

void StagedFile::commit() {
  if (stream_.is_open()) {
    stream_.close();
    if (stream_.fail())
      throw Error(ErrorCode::bad_file, file_name(path_) + " cannot be written",
                  "check permission and space on the disk");
  }
  std::error_code failure;
  std::filesystem::rename(aside_, path_, failure);
  if (failure)
    throw Error(ErrorCode::bad_file, file_name(path_) + " cannot be written: " + failure.message(),
                "check permission and space on the disk");
  committed_ = true;
}

}  // namespace asperity
