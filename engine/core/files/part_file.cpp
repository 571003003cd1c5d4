// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/part_file.hpp"

#include <sys/random.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/digest.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view part_ending = ".part";
constexpr std::size_t place_digits = 8, random_digits = 16;
constexpr auto longest_silence = std::chrono::hours(24);

// Host and name space of processes, for a number of a process means nothing elsewhere.
std::string place_of_this_process() {
  utsname system{};
  const std::string host = ::uname(&system) == 0 ? system.nodename : "";
  std::array<char, 64> processes{};
  const ssize_t length = ::readlink("/proc/self/ns/pid", processes.data(), processes.size());
  Digester digester;
  digester.add(host).add(
      std::string_view(processes.data(), static_cast<std::size_t>(length > 0 ? length : 0)));
  return digester.hex().substr(0, place_digits);
}

const std::string& own_place() {
  static const std::string place = place_of_this_process();
  return place;
}

std::uint64_t random_bits() {
  std::uint64_t bits = 0;
  if (::getrandom(&bits, sizeof bits, 0) == static_cast<ssize_t>(sizeof bits)) return bits;
  std::random_device device;
  return (std::uint64_t{device()} << 32) | device();
}

bool is_made_of(std::string_view text, std::string_view digits, std::size_t least, std::size_t most) {
  return text.size() >= least && text.size() <= most &&
         text.find_first_not_of(digits) == std::string_view::npos;
}

struct Writer {
  std::string_view place;  // empty in names of earlier versions
  std::int64_t process = 0;
};

// "1a2b3c4d-1234-0011223344556677", or "1234-5" as it was before.
std::optional<Writer> writer_of(std::string_view token) {
  constexpr std::string_view decimal = "0123456789", hexadecimal = "0123456789abcdef";
  const std::size_t first = token.find('-'), last = token.rfind('-');
  if (first == std::string_view::npos) return {};
  Writer writer;
  std::string_view number = token.substr(0, first);
  if (first == last) {
    if (!is_made_of(token.substr(last + 1), decimal, 1, 10)) return {};
  } else {
    writer.place = token.substr(0, first);
    number = token.substr(first + 1, last - first - 1);
    if (!is_made_of(writer.place, hexadecimal, place_digits, place_digits)) return {};
    if (!is_made_of(token.substr(last + 1), hexadecimal, random_digits, random_digits)) return {};
  }
  if (!is_made_of(number, decimal, 1, 10)) return {};
  std::from_chars(number.data(), number.data() + number.size(), writer.process);
  return writer;
}

// The writer that the name of a part tells; the name must outlive it.
std::optional<Writer> writer_of_part(std::string_view name) {
  if (!name.starts_with('.')) return {};
  if (!name.ends_with(part_ending)) {
    const std::size_t dot = name.rfind('.');
    name = name.substr(0, dot);
    if (!name.ends_with(part_ending)) return {};
  }
  name.remove_suffix(part_ending.size());
  const std::size_t dot = name.rfind('.');
  if (dot == 0 || dot == std::string_view::npos) return {};
  return writer_of(name.substr(dot + 1));
}

}  // namespace

fs::path part_beside(const fs::path& target) {
  constexpr std::size_t longest_stem = 120, longest_extension = 24;
  std::array<char, random_digits + 1> random{};
  std::snprintf(random.data(), random.size(), "%016llx", static_cast<unsigned long long>(random_bits()));
  std::string extension = target.extension().string();
  if (extension.size() > longest_extension) extension.clear();
  return target.parent_path() /
         ("." + target.stem().string().substr(0, longest_stem) + "." + own_place() + "-" +
          std::to_string(::getpid()) + "-" + random.data() + std::string(part_ending) + extension);
}

void find_own_place() { own_place(); }

bool is_part(const fs::path& file) { return writer_of_part(file.filename().native()).has_value(); }

bool is_abandoned(const fs::path& part) {
  const std::string name = part.filename().string();
  const std::optional<Writer> writer = writer_of_part(name);
  if (!writer) return false;
  if (!writer->place.empty() && writer->place == own_place() && writer->process > 0 &&
      ::kill(static_cast<pid_t>(writer->process), 0) != 0 && errno == ESRCH)
    return true;
  std::error_code gone;
  const fs::file_time_type written = fs::last_write_time(part, gone);
  return !gone && fs::file_time_type::clock::now() - written > longest_silence;
}

int sweep_parts(const fs::path& folder, Parts which, bool deep) {
  std::error_code problem;
  std::vector<fs::path> found, folders;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    std::error_code gone;
    const fs::file_status status = entry->symlink_status(gone);
    if (deep && fs::is_directory(status)) folders.push_back(entry->path());
    if (fs::is_regular_file(status) && is_part(entry->path())) found.push_back(entry->path());
  }
  int removed = 0;
  for (const fs::path& part : found)
    if ((which == Parts::all || is_abandoned(part)) && ::unlink(part.c_str()) == 0) ++removed;
  for (const fs::path& inner : folders) removed += sweep_parts(inner, which, deep);
  return removed;
}

}  // namespace asperity
