// SPDX-License-Identifier: GPL-3.0-or-later
// Reads in pieces, so that a stop takes effect and a wrong size field does no harm.
#include "engine/core/files/source_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/core/files/text_encoding.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::size_t piece = std::size_t{1} << 20;

// `expected`, from the file system, may be wrong.
template <class Bytes, class Advance>
void read_to_end(std::ifstream& stream, const std::string& path, std::size_t expected, Bytes& bytes,
                 const Advance& advance) {
  require_room_for(path, expected);
  bytes.reserve(expected);
  while (stream) {
    const std::size_t held = bytes.size();
    const std::size_t wanted = std::max<std::size_t>(1, std::min(piece, expected - std::min(expected, held)));
    bytes.resize(held + wanted);
    stream.read(bytes.data() + held, static_cast<std::streamsize>(wanted));
    bytes.resize(held + static_cast<std::size_t>(stream.gcount()));
    advance(stream.gcount());
  }
  if (stream.bad()) refuse_bad_file(file_name(path) + " cannot be read to its end", "check the disk");
}

}  // namespace

void require_room_for(const std::string& path, std::uintmax_t bytes) {
  const std::int64_t limit = memory::limit();
  const std::int64_t most =
      limit > 0 ? std::max<std::int64_t>(0, limit - memory::held()) : memory::of_machine() / 4;
  if (bytes <= static_cast<std::uintmax_t>(most)) return;
  const std::string found = file_name(path) + " has " + format_bytes(static_cast<std::int64_t>(bytes));
  if (limit > 0)
    throw Error(ErrorCode::out_of_memory, found + ", and the memory limit leaves " + format_bytes(most),
                "read a smaller file, or raise the limit");
  throw Error(ErrorCode::out_of_memory,
              found + ", which is more than a quarter of this machine's memory (" + format_bytes(most) + ")",
              "read a smaller file, or allow more with `--limit-memory`");
}

std::string text_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse_bad_file(file_name(path) + " cannot be opened", "check that it may be read");
  std::error_code unknown;
  const std::uintmax_t expected = std::filesystem::file_size(path, unknown);
  std::string text;
  read_to_end(stream, path, unknown ? 0 : static_cast<std::size_t>(expected), text, [](std::streamsize) {});
  return text;
}

std::string file_extension(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  return lower_case(ending);
}

std::string file_name(const std::string& path) { return "\"" + path + "\""; }

void refuse_file(const SourceFile& file, const std::string& finding, const std::string& hint) {
  refuse_bad_file(file_name(file.path()) + " " + finding, hint);
}

SourceFile::SourceFile(std::string path, Monitor& monitor)
    : path_(std::move(path)), extension_(file_extension(path_)) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path_, failure);
  if (status.type() == fs::file_type::not_found || path_.empty())
    refuse_bad_file("there is no file " + file_name(path_), "check the path and its spelling");
  if (status.type() == fs::file_type::directory)
    refuse_bad_file(file_name(path_) + " is a directory", "give the path of a file in it");
  if (status.type() != fs::file_type::regular)
    refuse_bad_file(file_name(path_) + " is not a plain file", "give the path of a measured file");
  std::ifstream stream(path_, std::ios::binary);
  if (!stream) refuse_bad_file(file_name(path_) + " cannot be opened", "check that it may be read");
  const std::uintmax_t expected = fs::file_size(path_, failure);
  if (failure) refuse_bad_file(file_name(path_) + " cannot be read");
  Task task(monitor, "reading", static_cast<std::int64_t>(expected));
  read_to_end(stream, path_, static_cast<std::size_t>(expected), bytes_,
              [&](std::streamsize read) { task.advance(read); });
  refuse_empty();
}

SourceFile::SourceFile(std::string name, std::string_view bytes)
    : path_(std::move(name)), extension_(file_extension(path_)), bytes_(bytes.begin(), bytes.end()) {
  refuse_empty();
}

SourceFile::SourceFile(std::string name, Array<char> bytes, std::string extension)
    : path_(std::move(name)), extension_(std::move(extension)), bytes_(std::move(bytes)) {
  refuse_empty();
}

void SourceFile::refuse_empty() const {
  if (bytes_.empty()) refuse_bad_file(file_name(path_) + " is empty", "write it again");
}

std::string_view SourceFile::text() const {
  std::string_view view = bytes();
  if (is_utf16(view)) {
    if (decoded_.empty()) decoded_ = *utf8_of_utf16(view);
    return decoded_;
  }
  if (view.starts_with("\xEF\xBB\xBF")) view.remove_prefix(3);
  return view;
}

bool SourceFile::looks_like_text() const {
  return is_utf16(bytes()) || bytes().substr(0, 4096).find('\0') == std::string_view::npos;
}

}  // namespace asperity
