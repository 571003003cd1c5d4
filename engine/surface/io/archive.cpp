// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/archive.hpp"

#include <algorithm>
#include <array>

#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

void Md5::add(std::span<const char> bytes) {
  MD5Update(&context_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Md5::hex() {
  std::array<std::uint8_t, MD5_DIGEST_LENGTH> digest;
  MD5Final(digest.data(), &context_);
  return hexadecimal(digest);
}

namespace {

std::string plain_entry(std::string_view text) {
  std::string result = lower_case(text);
  std::replace(result.begin(), result.end(), '\\', '/');
  while (result.starts_with("./")) result.erase(0, 2);
  while (result.starts_with("/")) result.erase(0, 1);
  return result;
}

}  // namespace

Archive::Archive(const SourceFile& file) : file_(file), zip_(nullptr, zip_discard) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(file.bytes().data(), file.bytes().size(), 0, &error);
  if (source != nullptr) {
    zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!zip_) zip_source_free(source);
  }
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (!zip_)
    refuse_file(file, "is not a whole zip archive (" + reason + ")", "the file is cut short or damaged");
  const zip_int64_t count = zip_get_num_entries(zip_.get(), 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const char* const name = zip_get_name(zip_.get(), static_cast<zip_uint64_t>(k), ZIP_FL_ENC_RAW);
    names_.push_back(plain_entry(name == nullptr ? "" : name));
  }
}

std::string Archive::folder_of(std::string_view name) const {
  const std::string wanted = "/" + plain_entry(name);
  std::string folder;
  for (const std::string& found : names_) {
    if (found == wanted.substr(1)) return {};
    if (!found.ends_with(wanted)) continue;
    if (!folder.empty()) return {};
    folder = found.substr(0, found.size() - wanted.size() + 1);
  }
  return folder;
}

std::int64_t Archive::find(std::string_view name) const {
  const auto found = std::ranges::find(names_, plain_entry(name));
  return found == names_.end() ? -1 : found - names_.begin();
}

std::string Archive::entry_text(std::int64_t index) const {
  const char* const name = zip_get_name(zip_.get(), static_cast<zip_uint64_t>(index), ZIP_FL_ENC_RAW);
  return "the entry \"" + plain_text(name == nullptr ? "?" : name) + "\"";
}

std::uint64_t Archive::claimed_size(std::int64_t index) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat_index(zip_.get(), static_cast<zip_uint64_t>(index), 0, &stat) != 0 ||
      (stat.valid & ZIP_STAT_SIZE) == 0 || (stat.valid & ZIP_STAT_COMP_SIZE) == 0 ||
      (stat.valid & ZIP_STAT_COMP_METHOD) == 0)
    refuse_file(file_, "has a damaged zip directory");
  if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
    refuse_file(file_,
                "has " + entry_text(index) + " packed by zip method " + std::to_string(stat.comp_method),
                "pack it again, stored or deflated");
  if (stat.comp_size > file_.bytes().size() || stat.size / most_of_deflate > stat.comp_size)
    refuse_file(file_,
                "has " + entry_text(index) + " of " + std::to_string(stat.size) + " bytes packed in " +
                    std::to_string(stat.comp_size) + ", which is impossible",
                "the file is cut short or damaged");
  require_room_for(file_.path(), stat.size);
  return stat.size;
}

Array<char> Archive::contents(std::int64_t index, std::uint64_t limit) const {
  const std::uint64_t size = claimed_size(index);
  if (size > limit)
    refuse_file(file_, "has " + entry_text(index) + " of " + std::to_string(size) +
                           " bytes, above the limit of " + std::to_string(limit));
  Array<char> bytes(static_cast<std::size_t>(size));
  ArchiveEntry entry(*this, index);
  entry.read(bytes);
  entry.expect_end();
  return bytes;
}

ArchiveEntry::ArchiveEntry(const Archive& archive, std::int64_t index)
    : archive_(archive),
      index_(index),
      handle_(zip_fopen_index(archive.zip_.get(), static_cast<zip_uint64_t>(index), 0), zip_fclose) {
  if (!handle_) refuse(std::string("cannot be unpacked (") + zip_strerror(archive.zip_.get()) + ")");
}

void ArchiveEntry::refuse(const std::string& finding) const {
  refuse_file(archive_.file_, "is damaged: " + archive_.entry_text(index_) + " " + finding,
              "copy the file again from its source");
}

void ArchiveEntry::read(std::span<char> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const zip_int64_t got = zip_fread(handle_.get(), bytes.data() + filled, bytes.size() - filled);
    if (got <= 0)
      refuse(got == 0 ? "holds less data than it says"
                      : std::string("cannot be unpacked (") + zip_file_strerror(handle_.get()) + ")");
    filled += static_cast<std::size_t>(got);
  }
  md5_.add(bytes);
}

void ArchiveEntry::expect_end() {
  char extra = 0;
  const zip_int64_t got = zip_fread(handle_.get(), &extra, 1);
  if (got > 0) refuse("holds more data than it says");
  if (got < 0) refuse(std::string("cannot be unpacked (") + zip_file_strerror(handle_.get()) + ")");
}

}  // namespace asperity
