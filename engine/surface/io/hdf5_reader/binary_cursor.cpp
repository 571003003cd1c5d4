// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

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

void require_numbers(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  const std::string claim = std::to_string(nx) + " x " + std::to_string(ny);
  if (nx == 0 || ny == 0 || nx > most || ny > most)
    refuse_file(file, "says in its header that it holds " + claim + " heights");
  if (nx > present / width / ny)
    refuse_file(file,
                "says in its header that it holds " + claim + " heights of " + std::to_string(width) +
                    (width == 1 ? " byte" : " bytes") + " but has " + std::to_string(present) +
                    " bytes of data",
                "the file is cut short or its header is wrong");
}

void require_exactly(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present) {
  require_numbers(file, nx, ny, width, present);
  const std::uint64_t wanted = nx * ny * width;
  if (present != wanted)
    refuse_file(file,
                "says in its header that it holds " + std::to_string(nx) + " x " + std::to_string(ny) +
                    " heights of " + std::to_string(width) + (width == 1 ? " byte" : " bytes") + " but has " +
                    std::to_string(present) + " bytes of data, " + std::to_string(present - wanted) +
                    " too many",
                "its header is wrong or the file is damaged: read so, its lines would be shifted");
}

void warn_of_bytes_over(const SourceFile& file, std::uint64_t over, Monitor& monitor) {
  if (over == 0) return;
  monitor.warn(file_name(file.path()) + " goes on for " + std::to_string(over) +
               (over == 1 ? " byte" : " bytes") +
               " after the end that it states; they are not read: something was appended to it, or it was "
               "written over a longer file");
}

}  // namespace asperity
