// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

#include <zlib.h>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

std::string_view BinaryCursor::take(std::size_t count) {
  if (count > left()) refuse_file(file_, "is cut short in " + what_);
  const std::string_view taken = bytes_.substr(at_, count);
  at_ += count;
  return taken;
}

std::string_view BinaryCursor::text(std::size_t width) {
  std::string_view field = take(width);
  field = field.substr(0, field.find('\0'));
  while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
  return field;
}

std::string_view BinaryCursor::ended_text() {
  const std::size_t end = bytes_.find('\0', at_);
  if (end == std::string_view::npos) refuse_file(file_, "is cut short in " + what_);
  const std::string_view found = bytes_.substr(at_, end - at_);
  at_ = end + 1;
  return found;
}

std::string_view bytes_at(const SourceFile& file, std::uint64_t at, std::uint64_t length,
                          const std::string& what) {
  const std::string_view bytes = file.bytes();
  if (at > bytes.size() || length > bytes.size() - at)
    refuse_file(file, "has " + what + " past its end", "the file is cut short");
  return bytes.substr(at, length);
}

namespace {

std::string claim_of(std::uint64_t nx, std::uint64_t ny, std::uint64_t width, std::uint64_t present) {
  return "says in its header that it holds " + std::to_string(nx) + " x " + std::to_string(ny) +
         " heights of " + std::to_string(width) + (width == 1 ? " byte" : " bytes") + " but has " +
         std::to_string(present) + " bytes of data";
}

}  // namespace

void require_numbers(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  if (nx == 0 || ny == 0 || nx > most || ny > most)
    refuse_file(
        file,
        "says in its header that it holds " + std::to_string(nx) + " x " + std::to_string(ny) + " heights",
        "its header is wrong");
  if (nx > present / width / ny)
    refuse_file(file, claim_of(nx, ny, width, present), "the file is cut short or its header is wrong");
}

void require_exactly(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present) {
  require_numbers(file, nx, ny, width, present);
  const std::uint64_t wanted = nx * ny * width;
  if (present != wanted)
    refuse_file(file,
                claim_of(nx, ny, width, present) + ", " + std::to_string(present - wanted) + " too many",
                "its header is wrong or the file is damaged");
}

double above_zero(const SourceFile& file, double value, const std::string& unit_and_place) {
  if (!(value > 0) || !std::isfinite(value))
    refuse_file(file, "gives " + format_short(value) + " " + unit_and_place);
  return value;
}

std::string listed_up_to(std::size_t most, std::vector<std::string> names) {
  if (names.size() > most) {
    const std::size_t more = names.size() - most;
    names.resize(most);
    names.push_back(std::to_string(more) + " more");
  }
  return joined(names, " and ");
}

void warn_of_bytes_over(const SourceFile& file, std::uint64_t over, Monitor& monitor) {
  if (over == 0) return;
  monitor.warn(file_name(file.path()) + " has " + std::to_string(over) + (over == 1 ? " byte" : " bytes") +
               " after its stated end; they are not read: check whether the file is damaged");
}

Array<char> inflated(const SourceFile& file, std::string_view packed, std::uint64_t wanted,
                     std::string_view what) {
  if (wanted / most_of_deflate > packed.size())
    refuse_file(file,
                "claims that " + std::string(what) + " unpack from " + std::to_string(packed.size()) +
                    " bytes to " + std::to_string(wanted) + ", which is impossible",
                "its header is wrong or the file is damaged");
  Array<char> plain(static_cast<std::size_t>(wanted));
  uLongf length = plain.size();
  const int status = ::uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (status == Z_MEM_ERROR)
    throw Error(ErrorCode::out_of_memory,
                "no memory to unpack " + format_bytes(static_cast<std::int64_t>(wanted)));
  if (status != Z_OK || length != plain.size())
    refuse_file(file,
                "does not unpack: " + std::string(what) + " should be " + std::to_string(wanted) +
                    " bytes out of " + std::to_string(packed.size()),
                "the file is cut short or damaged");
  return plain;
}

}  // namespace asperity
