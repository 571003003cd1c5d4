// SPDX-License-Identifier: GPL-3.0-or-later
// The only reader that includes libzip and libmd.
#include "engine/surface/io/archive.hpp"

#include <md5.h>
#include <zip.h>

#include <algorithm>
#include <array>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"

namespace asperity {

struct Md5::State {
  MD5_CTX context;
};

Md5::Md5() : state_(std::make_unique<State>()) { MD5Init(&state_->context); }
Md5::~Md5() = default;

void Md5::add(std::span<const char> bytes) {
  MD5Update(&state_->context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Md5::hex() {
  std::array<std::uint8_t, MD5_DIGEST_LENGTH> digest;
  MD5Final(digest.data(), &state_->context);
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

struct Archive::State {
  zip_t* zip = nullptr;
  ~State() {
    if (zip != nullptr) zip_discard(zip);
  }
};

Archive::Archive(const SourceFile& file) : file_(file), state_(std::make_unique<State>()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(file.bytes().data(), file.bytes().size(), 0, &error);
  if (source != nullptr) {
    state_->zip = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (state_->zip == nullptr) zip_source_free(source);
  }
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (state_->zip == nullptr)
    refuse_file(file, "is not a whole zip archive (" + reason + ")", "the file is cut short or damaged");
}

Archive::~Archive() = default;

namespace {

std::string plain_entry(std::string_view text) {
  std::string result = lower_case(text);
  std::replace(result.begin(), result.end(), '\\', '/');
  while (result.starts_with("./")) result.erase(0, 2);
  while (result.starts_with("/")) result.erase(0, 1);
  return result;
}

}  // namespace

std::string Archive::folder_of(std::string_view name) const {
  const std::string wanted = "/" + plain_entry(name);
  std::string folder;
  const zip_int64_t count = zip_get_num_entries(state_->zip, 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const char* const entry = zip_get_name(state_->zip, static_cast<zip_uint64_t>(k), ZIP_FL_ENC_RAW);
    if (entry == nullptr) continue;
    const std::string found = plain_entry(entry);
    if (found == wanted.substr(1)) return {};
    if (!found.ends_with(wanted)) continue;
    if (!folder.empty()) return {};
    folder = found.substr(0, found.size() - wanted.size() + 1);
  }
  return folder;
}

std::int64_t Archive::find(std::string_view name) const {
  const std::string wanted = plain_entry(name);
  const zip_int64_t count = zip_get_num_entries(state_->zip, 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const char* const entry = zip_get_name(state_->zip, static_cast<zip_uint64_t>(k), ZIP_FL_ENC_RAW);
    if (entry != nullptr && plain_entry(entry) == wanted) return k;
  }
  return -1;
}

std::string Archive::entry_text(std::int64_t index) const {
  const char* const name = zip_get_name(state_->zip, static_cast<zip_uint64_t>(index), ZIP_FL_ENC_RAW);
  return "the entry \"" + plain_text(name == nullptr ? "?" : name) + "\"";
}

std::uint64_t Archive::claimed_size(std::int64_t index) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat_index(state_->zip, static_cast<zip_uint64_t>(index), 0, &stat) != 0 ||
      (stat.valid & ZIP_STAT_SIZE) == 0 || (stat.valid & ZIP_STAT_COMP_SIZE) == 0 ||
      (stat.valid & ZIP_STAT_COMP_METHOD) == 0)
    refuse_file(file_, "has a damaged zip directory");
  if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
    refuse_file(file_,
                "has " + entry_text(index) + " packed by zip method " + std::to_string(stat.comp_method),
                "pack it again, stored or deflated");
  // Deflate expands by a factor of at most 1032.
  constexpr std::uint64_t greatest_ratio = 1032;
  if (stat.comp_size > file_.bytes().size() || stat.size / greatest_ratio > stat.comp_size)
    refuse_file(file_,
                "has " + entry_text(index) + " of " + std::to_string(stat.size) + " bytes packed in " +
                    std::to_string(stat.comp_size) + ", which cannot be",
                "the file is cut short or damaged");
  require_room_for(file_.path(), stat.size);
  return stat.size;
}

Array<char> Archive::contents(std::int64_t index, std::uint64_t limit) const {
  const std::uint64_t size = claimed_size(index);
  if (size > limit)
    refuse_file(file_, "has " + entry_text(index) + " of " + std::to_string(size) + " bytes where at most " +
                           std::to_string(limit) + " make sense");
  Array<char> bytes(static_cast<std::size_t>(size));
  ArchiveEntry entry(*this, index);
  entry.read(bytes);
  entry.expect_end();
  return bytes;
}

struct ArchiveEntry::Handle {
  zip_file_t* file = nullptr;
  ~Handle() {
    if (file != nullptr) zip_fclose(file);
  }
};

ArchiveEntry::ArchiveEntry(const Archive& archive, std::int64_t index)
    : archive_(archive), index_(index), handle_(std::make_unique<Handle>()) {
  handle_->file = zip_fopen_index(archive.state_->zip, static_cast<zip_uint64_t>(index), 0);
  if (handle_->file == nullptr)
    refuse(std::string("cannot be unpacked (") + zip_strerror(archive.state_->zip) + ")");
}

ArchiveEntry::~ArchiveEntry() = default;

void ArchiveEntry::refuse(const std::string& finding) const {
  refuse_file(archive_.file_, "is damaged: " + archive_.entry_text(index_) + " " + finding,
              "copy the file again from its source");
}

void ArchiveEntry::read(std::span<char> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const zip_int64_t got = zip_fread(handle_->file, bytes.data() + filled, bytes.size() - filled);
    if (got <= 0)
      refuse(got == 0 ? "holds less data than it says"
                      : std::string("cannot be unpacked (") + zip_file_strerror(handle_->file) + ")");
    filled += static_cast<std::size_t>(got);
  }
  md5_.add(bytes);
}

void ArchiveEntry::expect_end() {
  char extra = 0;
  const zip_int64_t got = zip_fread(handle_->file, &extra, 1);
  if (got > 0) refuse("holds more data than it says");
  if (got < 0) refuse(std::string("cannot be unpacked (") + zip_file_strerror(handle_->file) + ")");
}

}  // namespace asperity
