// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/result_log.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "engine/core/digest.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view mark = "ASR1", ending = ".results";
constexpr std::size_t digits = 32;  // of digest and name
constexpr std::size_t head = mark.size() + sizeof(std::uint32_t) + 2 * digits;
static_assert(head == ResultLog::bytes_beside);
constexpr std::size_t longest = std::size_t{8} << 20;  // a record fits into one read
constexpr auto sync_every = std::chrono::seconds(1);

std::string digest_of(std::string_view name, std::string_view bytes) {
  return Digester().add(mark).add(name).add(bytes).hex();
}

// Fewer bytes at the end of the file.
std::string bytes_at(const fs::path& path, std::int64_t offset, std::size_t length) {
  const ScopedFile file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  std::string bytes(file.number < 0 ? 0 : length, '\0');
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t more = ::pread(file.number, bytes.data() + got, bytes.size() - got,
                                 static_cast<off_t>(offset + static_cast<std::int64_t>(got)));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    got += static_cast<std::size_t>(more);
  }
  bytes.resize(got);
  return bytes;
}

struct Record {
  std::string_view digest, name, bytes;
  bool sound() const { return digest == digest_of(name, bytes); }
};
std::size_t length_in(std::string_view text) {
  std::uint32_t length = 0;
  std::memcpy(&length, text.data() + mark.size(), sizeof length);
  return length;
}
std::optional<Record> record_in(std::string_view text) {
  if (text.size() < head || text.size() - head < length_in(text)) return {};
  const std::string_view after = text.substr(mark.size() + sizeof(std::uint32_t));
  return Record{after.substr(0, digits), after.substr(digits, digits),
                after.substr(2 * digits, length_in(text))};
}

}  // namespace

void write_result(const std::string& key, const ResultFacts& facts, const KeptFields& fields,
                  const std::function<void(std::string_view)>& take) {
  ByteWriter out;
  out.text(key).count(facts.numbers.size());
  for (const auto& [name, value] : facts.numbers) out.text(name).number(value);
  out.count(facts.texts.size());
  for (const auto& [name, text] : facts.texts) out.text(name).text(text);
  out.number(facts.cost.seconds).number(facts.cost.transforms).number(facts.cost.bytes).count(fields.size());
  for (const auto& [name, field] : fields) {
    out.text(name).number(field->nx()).number(field->ny()).count(field->size());
    take(out.take());
    take({reinterpret_cast<const char*>(field->data()), field->values().size_bytes()});
  }
  take(out.take());
}

std::string result_bytes(const std::string& key, const ResultFacts& facts, const KeptFields& fields) {
  std::string bytes;
  write_result(key, facts, fields, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

FoundResult result_from(ByteReader& in) {
  FoundResult found;
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    found.numbers.emplace_back(std::move(name), in.number<double>());
  }
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    found.texts.emplace_back(std::move(name), in.text());
  }
  found.cost.seconds = in.number<double>();
  found.cost.transforms = in.number<decltype(found.cost.transforms)>();
  found.cost.bytes = in.number<decltype(found.cost.bytes)>();
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    const int nx = in.number<int>(), ny = in.number<int>();
    auto values = in.numbers([](std::size_t length) { return UnsetArray<double>(length); });
    if (nx < 0 || ny < 0 || std::int64_t{nx} * ny != std::ssize(values)) ByteReader::damaged();
    found.fields.emplace_back(std::move(name), Field(nx, ny, std::move(values)));
  }
  return found;
}

ResultLog::~ResultLog() { leave_file(); }

std::optional<ResultLog::Found> ResultLog::find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  for (bool looked = false;; looked = true) {
    if (const auto at = places_.find(name); at != places_.end()) {
      const Place place = at->second;
      if (std::optional<std::string> bytes = record_at(place, name))
        return Found{*std::move(bytes), files_[static_cast<std::size_t>(place.file)].path};
      places_.erase(at);  // the file was removed or changed
    }
    if (looked) return {};
    look();
  }
}

// The folder's time changes with new files, except within one clock step; names are read until it is one
// second old.
void ResultLog::look() {
  std::error_code missing;
  const fs::file_time_type changed = fs::last_write_time(folder_, missing);
  if (missing) return;
  if (!listed_once_ || !settled_ || changed != listed_) {
    settled_ = fs::file_time_type::clock::now() - changed > std::chrono::seconds(1);
    listed_ = changed;
    listed_once_ = true;
    for (fs::directory_iterator entry(folder_, missing), end; !missing && entry != end;
         entry.increment(missing)) {
      std::string name = entry->path().filename().string();
      if (!name.ends_with(ending) || known_.contains(name)) continue;
      known_.emplace(std::move(name), static_cast<int>(files_.size()));
      files_.push_back({entry->path()});
    }
  }
  for (std::size_t k = 0; k < files_.size(); ++k)
    if (!files_[k].own && !files_[k].damaged) go_through(static_cast<int>(k));
}

void ResultLog::go_through(int number) {
  File& file = files_[static_cast<std::size_t>(number)];
  struct ::stat facts {};
  if (::lstat(file.path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode) || facts.st_size <= file.read)
    return;
  constexpr std::int64_t most_at_once = std::int64_t{16} << 20;
  for (;;) {
    const std::string text =
        bytes_at(file.path, file.read,
                 static_cast<std::size_t>(std::min<std::int64_t>(facts.st_size - file.read, most_at_once)));
    std::string_view rest = text;
    const auto damaged = [&](const std::string& what) {
      note_(file.path.string(),
            quoted(file.path.string()) + " is damaged " + what + "; it was computed again");
    };
    while (rest.size() >= head) {
      if (!rest.starts_with(mark) || length_in(rest) > longest) {
        damaged("from byte " + std::to_string(file.read) + " on");
        file.damaged = true;
        return;
      }
      const std::optional<Record> record = record_in(rest);
      if (!record) break;
      const std::size_t length = head + record->bytes.size();
      if (record->sound())
        places_[std::string(record->name)] = {number, file.read, static_cast<std::int64_t>(length)};
      else
        damaged("at byte " + std::to_string(file.read));
      file.read += static_cast<std::int64_t>(length);
      rest.remove_prefix(length);
    }
    // The record exceeds this read, or is unfinished.
    if (rest.size() == text.size() || file.read >= facts.st_size) return;
  }
}

std::optional<std::string> ResultLog::record_at(const Place& place, std::string_view name) {
  const std::string text = bytes_at(files_[static_cast<std::size_t>(place.file)].path, place.offset,
                                    static_cast<std::size_t>(place.length));
  if (text.size() != static_cast<std::size_t>(place.length) || !text.starts_with(mark)) return {};
  const std::optional<Record> record = record_in(text);
  if (!record || !record->sound() || record->name != name) return {};
  return std::string(record->bytes);
}

fs::path ResultLog::keep(const std::string& name, std::string_view bytes) {
  if (name.size() != digits || bytes.size() > longest)
    throw Error(ErrorCode::internal, "a result of this name or length does not fit into a log");
  const std::string digest = digest_of(name, bytes);
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::string record(mark);
  record.reserve(head + bytes.size());
  record.append(reinterpret_cast<const char*>(&length), sizeof length).append(digest).append(name);
  record.append(bytes);

  std::unique_lock lock(mutex_);
  if (own_ >= 0 && files_[static_cast<std::size_t>(own_)].read >= longest_file) {
    lock.unlock();
    wait_for_disk();
    lock.lock();
    leave_file();
  }
  if (descriptor_ < 0) begin_file();
  File& own = files_[static_cast<std::size_t>(own_)];
  append_whole(descriptor_, record, own.path);
  places_[name] = {own_, own.read, static_cast<std::int64_t>(record.size())};
  own.read += static_cast<std::int64_t>(record.size());
  ++written_;
  fs::path path = own.path;
  if (std::chrono::steady_clock::now() >= next_sync_ && !syncing_) {
    syncing_ = true;
    lock.unlock();
    wait_for_disk();
  }
  return path;
}

void ResultLog::wait_for_disk() {
  std::unique_lock lock(mutex_);
  if (descriptor_ < 0 || synced_ == written_) {
    syncing_ = false;
    return;
  }
  const std::int64_t written = written_;
  const ScopedFile file(::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0));
  const fs::path path = files_[static_cast<std::size_t>(own_)].path;
  lock.unlock();
  const int reason = file.number < 0 || (::fsync(file.number) != 0 && errno != EINVAL) ? errno : 0;
  struct ::stat facts {};
  const bool gone = reason == 0 && ::fstat(file.number, &facts) == 0 && facts.st_nlink == 0;
  lock.lock();
  syncing_ = false;
  next_sync_ = std::chrono::steady_clock::now() + sync_every;
  if (reason != 0) throw_file_error("write", path, reason);
  synced_ = std::max(synced_, written);
  // Another process may have deleted the file to free space.
  if (gone && own_ >= 0 && files_[static_cast<std::size_t>(own_)].path == path) leave_file();
}

// Random: other processes may remember a position in a deleted file.
void ResultLog::begin_file() {
  std::error_code problem;
  fs::create_directory(folder_, problem);
  if (problem) throw_file_error("make the folder", folder_, problem.value());
  std::string name = random_name() + std::string(ending);
  const fs::path path = folder_ / name;
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_file_error("write", path, errno);
  own_ = static_cast<int>(files_.size());
  known_[std::move(name)] = own_;
  files_.push_back({path, 0, false, true});
  // Names of the file and of the folder.
  asperity::wait_for_disk(folder_);
  asperity::wait_for_disk(folder_.parent_path());
}

void ResultLog::leave_file() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  own_ = -1;
  synced_ = written_;
}

}  // namespace asperity
