// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/deflated.hpp"

#include <zlib.h>

#include <algorithm>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::string_view gzip_mark = "\x1F\x8B\x08";

class GzipStream {
 public:
  explicit GzipStream(std::string_view packed) {
    constexpr int gzip_alone = 16;
    if (inflateInit2(&stream_, MAX_WBITS + gzip_alone) != Z_OK)
      throw Error(ErrorCode::out_of_memory, "there is no memory to unpack gzip");
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    left_ = packed.size();
  }
  ~GzipStream() { inflateEnd(&stream_); }
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  int fill(char* at, std::size_t room, std::size_t& came) {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    const auto given = static_cast<uInt>(std::min(left_, most));
    const auto asked = static_cast<uInt>(std::min(room, most));
    stream_.avail_in = given;
    stream_.avail_out = asked;
    stream_.next_out = reinterpret_cast<Bytef*>(at);
    const int status = inflate(&stream_, Z_NO_FLUSH);
    left_ -= given - stream_.avail_in;
    came = asked - stream_.avail_out;
    return status;
  }
  std::string_view rest() const { return {reinterpret_cast<const char*>(stream_.next_in), left_}; }
  void next_piece() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
  std::size_t left_ = 0;
};

std::string ending_inside(const std::string& path) {
  constexpr std::string_view gz = ".gz";
  const std::string plain = path.substr(0, path.size() - std::min(path.size(), gz.size()));
  return file_extension(path) == "gz" ? file_extension(plain) : file_extension(path);
}

}  // namespace

std::uint64_t most_of_gzip(const SourceFile& file) {
  constexpr std::uint64_t always = std::uint64_t{16} << 20, a_byte = 128;
  return std::max(always, a_byte * file.bytes().size());
}

std::optional<SourceFile> inside_gzip(const SourceFile& file, Monitor& monitor) {
  const std::string_view packed = file.bytes();
  if (!packed.starts_with(gzip_mark)) return {};
  const std::uint64_t most = most_of_gzip(file);
  constexpr std::size_t first = std::size_t{1} << 16;
  GzipStream stream(packed);
  Array<char> plain;
  std::size_t filled = 0;
  Task task(monitor, "unpacking", static_cast<std::int64_t>(packed.size()));
  std::size_t told = 0;
  const auto check_size = [&] {
    if (filled > most)
      refuse_file(file,
                  "unpacks to more than " + format_bytes(static_cast<std::int64_t>(most)) + " out of " +
                      format_bytes(static_cast<std::int64_t>(packed.size())),
                  "if it does hold heights, unpack it with gunzip and read the file inside");
  };
  for (;;) {
    if (filled == plain.size()) {
      check_size();
      plain.resize(std::min<std::size_t>(std::max(first, 2 * filled), static_cast<std::size_t>(most) + 1));
    }
    std::size_t came = 0;
    const int status = stream.fill(plain.data() + filled, plain.size() - filled, came);
    filled += came;
    const std::size_t now = packed.size() - stream.rest().size();
    task.advance(static_cast<std::int64_t>(now - told));
    told = now;
    if (status == Z_STREAM_END) {
      if (stream.rest().starts_with(gzip_mark)) {
        stream.next_piece();
        continue;
      }
      break;
    }
    if (status == Z_MEM_ERROR) throw Error(ErrorCode::out_of_memory, "there is no memory to unpack gzip");
    if (status != Z_OK && status != Z_BUF_ERROR)
      refuse_file(file, "is packed with gzip and does not unpack", "the file is damaged");
    if (came == 0 && stream.rest().empty())
      refuse_file(file, "is packed with gzip and cut short", "fetch or pack it again");
  }
  const std::string_view rest = stream.rest();
  if (!std::all_of(rest.begin(), rest.end(), [](char c) { return c == '\0'; }))
    refuse_file(file, "has " + std::to_string(rest.size()) + " bytes after its packed data",
                "the file is damaged");
  check_size();
  plain.resize(filled);
  return SourceFile(file.path(), std::move(plain), ending_inside(file.path()));
}

}  // namespace asperity
