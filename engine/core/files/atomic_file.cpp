// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view part_ending = ".part";
constexpr std::size_t place_digits = 8, random_digits = 16;
constexpr auto longest_silence = std::chrono::hours(24);

// A process number is unique only on one host and in one PID namespace.
std::string place_of_this_process() {
  utsname system{};
  const std::string host = ::uname(&system) == 0 ? system.nodename : "";
  std::error_code unknown;
  const std::string processes = fs::read_symlink("/proc/self/ns/pid", unknown).string();
  return Digester().add(host).add(processes).hex().substr(0, place_digits);
}

const std::string& own_place() {
  static const std::string place = place_of_this_process();
  return place;
}

bool is_made_of(std::string_view text, std::string_view digits, std::size_t least, std::size_t most) {
  return text.size() >= least && text.size() <= most &&
         text.find_first_not_of(digits) == std::string_view::npos;
}

struct Writer {
  std::string_view place;  // empty in names of earlier versions
  std::int64_t process = 0;
};

// "1a2b3c4d-1234-0011223344556677", or "1234-5" of earlier versions.
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

// The result refers to `name`.
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

std::string name_of_data(const fs::path& file) { return "\"" + file.string() + "\""; }

constexpr std::string_view folder_lead = "asperity-";

// Only folders of this user; does not follow links.
void sweep(const fs::path& parent) {
  std::error_code problem;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(parent, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    struct ::stat facts {};
    if (entry->path().filename().native().starts_with("." + std::string(folder_lead)) &&
        ::lstat(entry->path().c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) &&
        facts.st_uid == ::geteuid() && is_abandoned(entry->path()))
      left.push_back(entry->path());
  }
  for (const fs::path& folder : left) fs::remove_all(folder, problem);
}

}  // namespace

AtomicFile::AtomicFile(fs::path target, FileWords words) : target_(std::move(target)), words_(words) {
  std::error_code ignored;
  if (words_ == FileWords::data) {
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
      refuse_bad_file("there is no directory " + name_of_data(folder) + " to write in", "make it first");
    if (fs::is_directory(target_, ignored) || !target_.has_filename())
      refuse_bad_file(name_of_data(target_) + " is a directory", "give the name of a file in it");
    if (fs::is_other(target_, ignored))
      refuse_bad_file(name_of_data(target_) + " is not a plain file", "give the name of one");
  } else if (fs::is_other(target_, ignored)) {
    refuse_bad_file("cannot write " + quoted(target_.string()) + ": it is a device or a pipe",
                    "give the name of a file");
  }
  temporary_ = part_beside(target_);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  close();
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes, unsigned mode) {
  if (descriptor_ < 0)
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
  if (const int reason = descriptor_ < 0 ? errno : write_all(descriptor_, bytes); reason != 0)
    refuse(reason, false);
}

void AtomicFile::commit(Durable durable) {
  if (descriptor_ < 0 && durable == Durable::yes) wait_for_disk(temporary_);
  if (descriptor_ >= 0) {
    int reason = durable == Durable::yes && ::fsync(descriptor_) != 0 && errno != EINVAL ? errno : 0;
    if (const int closing = close(); reason == 0) reason = closing;
    if (reason != 0) refuse(reason, false);
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(errno, true);
  committed_ = true;
}

int AtomicFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  return descriptor >= 0 && ::close(descriptor) != 0 ? errno : 0;
}

void AtomicFile::refuse(int reason, bool renaming) const {
  if (words_ == FileWords::run) throw_file_error("write", target_, reason);
  refuse_bad_file(name_of_data(target_) + " cannot be written" +
                      (renaming ? ": " + std::generic_category().message(reason) : std::string()),
                  "check permission and space on the disk");
}

void write_atomically(const fs::path& target, std::string_view content, Durable durable, unsigned mode) {
  AtomicFile file(target);
  file.write(content, mode);
  file.commit(durable);
}

void part_from_other_names(const fs::path& file) {
  const ScopedFile source(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct ::stat facts {};
  if (source.number < 0 || ::fstat(source.number, &facts) != 0 || !S_ISREG(facts.st_mode) ||
      facts.st_nlink < 2)
    return;
  AtomicFile copy(file);
  copy.write({}, facts.st_mode & 0777);
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t got = ::read(source.number, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw_file_error("read", file, errno);
    if (got == 0) break;
    copy.write({piece.data(), static_cast<std::size_t>(got)});
  }
  copy.commit(Durable::yes);
}

fs::path part_beside(const fs::path& target) {
  constexpr std::size_t longest_stem = 120, longest_extension = 24;
  std::string extension = target.extension().string();
  if (extension.size() > longest_extension) extension.clear();
  return target.parent_path() /
         ("." + target.stem().string().substr(0, longest_stem) + "." + own_place() + "-" +
          std::to_string(::getpid()) + "-" + random_name() + std::string(part_ending) + extension);
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

TemporaryFolder::TemporaryFolder(std::string_view purpose, const fs::path& parent) {
  std::error_code ignored;
  fs::path base = parent.empty() ? fs::temp_directory_path(ignored) : parent;
  if (base.empty()) base = "/tmp";
  sweep(base);
  path_ = part_beside(base / (std::string(folder_lead) + std::string(purpose)));
  if (::mkdir(path_.c_str(), 0700) != 0) throw_file_error("make a temporary folder in", base, errno);
}

void TemporaryFolder::remove() const {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace asperity
