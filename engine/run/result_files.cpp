// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/result_files.hpp"

#include <algorithm>

#include "engine/core/digest.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view form = "asperity result 2", file_ending = ".result";

std::string digest_of(std::string_view call, const std::string& key, const ResultFacts& facts,
                      const KeptFields& fields) {
  Digester digester;
  digester.add(form).add(call);
  write_result(key, facts, fields, [&](std::string_view piece) { digester.add(piece); });
  return digester.hex();
}

std::string not_kept(const Error& error) {
  return "a result could not be stored and is computed again on --resume: " + std::string(error.what());
}

std::int64_t bytes_of_result(const std::string& key, const FoundResult& result) {
  constexpr std::size_t each = 64;  // overhead, approximate
  std::size_t bytes = 4 * each + 2 * key.size();
  for (const auto& [name, value] : result.numbers) bytes += each + name.size();
  for (const auto& [name, text] : result.texts) bytes += each + name.size() + text.size();
  for (const auto& [name, field] : result.fields) bytes += each + name.size() + field.size() * sizeof(double);
  return static_cast<std::int64_t>(bytes);
}

// First: a refused copy counts against the run.
bool has_room(std::int64_t bytes) {
  const std::int64_t limit = memory::limit();
  return limit == 0 || memory::held() + bytes <= limit;
}

}  // namespace

ResultFiles::ResultFiles(ResultFilesSetup setup) : setup_(std::move(setup)), folders_({setup_.folder}) {
  // Another run may be writing.
  sweep_parts(setup_.folder, Parts::abandoned);
  folders_.insert(folders_.end(), setup_.also.begin(), setup_.also.end());
  for (const fs::path& folder : folders_)
    logs_.emplace_back(folder / ResultLog::folder_name,
                       [this](const std::string& file, std::string sentence) {
                         const std::lock_guard lock(mutex_);
                         note(file, std::move(sentence));
                       });
}

std::string ResultFiles::name_of(const std::string& key) const {
  return Digester().add(form).add(setup_.build).add(key).hex();
}

// Without the lock, which notices of a log take.
std::optional<FoundResult> ResultFiles::find_in_logs(const std::string& key, const std::string& name) {
  std::optional<ResultLog::Found> record = logs_.front().find(name);
  const bool own = record.has_value();
  for (std::size_t k = 1; !record && k < logs_.size(); ++k) record = logs_[k].find(name);
  if (!record) return {};
  std::optional<FoundResult> found;
  try {
    ByteReader in(record->bytes);
    if (in.text() != key) return {};
    found = result_from(in);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    return {};  // intact, another key
  }
  if (!own) keep_in_log(name, record->bytes);
  const std::lock_guard lock(mutex_);
  if (own && used_.insert(record->file.lexically_relative(setup_.folder).string()).second) {
    std::error_code problem;
    fs::last_write_time(record->file, fs::file_time_type::clock::now(), problem);
  }
  ++counts_.found;
  counts_.seconds_saved += found->cost.seconds;
  return found;
}

std::optional<FoundResult> ResultFiles::find(const std::string& key) {
  const std::string stem = name_of(key), name = stem + std::string(file_ending);
  if (std::optional<FoundResult> found = find_in_logs(key, stem)) return found;
  for (const fs::path& folder : folders_) {
    const fs::path file = folder / name;
    std::error_code problem;
    if (!fs::is_regular_file(file, problem)) continue;
    std::optional<FoundResult> found = read(file, key);
    if (!found) continue;
    const std::lock_guard lock(mutex_);
    if (folder == setup_.folder)
      fs::last_write_time(file, fs::file_time_type::clock::now(), problem);
    else
      bring_over(file, name);
    used_.insert(name);
    ++counts_.found;
    counts_.seconds_saved += found->cost.seconds;
    return found;
  }
  return {};
}

std::optional<FoundResult> ResultFiles::read(const fs::path& file, const std::string& key) {
  try {
    const SourceFile source(file.string(), Monitor::silent());
    ByteReader in(source.bytes());
    const std::string digest = in.text(), call = in.text();
    if (in.text() != key) ByteReader::damaged();
    FoundResult found = result_from(in);
    if (!in.at_end() || digest != digest_of(call, key, found, found.kept())) ByteReader::damaged();
    return found;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    const std::lock_guard lock(mutex_);
    note(file.string(), quoted(file.string()) + " is damaged or cannot be read; it was computed again");
    return {};
  }
}

void ResultFiles::bring_over(const fs::path& from, const std::string& name) {
  std::error_code problem;
  fs::create_directory(setup_.folder, problem);
  const fs::path to = setup_.folder / name;
  if (fs::exists(to, problem)) return;
  const auto bytes = fs::file_size(from, problem);
  if (problem || !make_room(static_cast<std::int64_t>(bytes))) return;
  fs::create_hard_link(from, to, problem);  // fails on another disk
  if (!problem) return;
  try {
    AtomicFile copy(to);  // others may copy it
    if (fs::copy_file(from, copy.temporary(), problem)) copy.commit();
  } catch (const Error&) {
    // the original remains
  }
}

void ResultFiles::keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                       const KeptFields& kept) {
  const double least = facts.one_of_many ? setup_.least_seconds_of_many : setup_.least_seconds;
  if (std::min(facts.cost.seconds, facts.processor_seconds) < std::max(least, facts.least_seconds) &&
      !facts.however_cheap)
    return;
  if (facts.one_of_many) {
    keep_in_log(name_of(key), result_bytes(key, facts, kept));
    return;
  }
  std::int64_t bytes = 4096;
  for (const auto& [name, field] : kept) bytes += static_cast<std::int64_t>(field->size() * sizeof(double));
  const std::string name = name_of(key) + std::string(file_ending);
  const std::lock_guard lock(mutex_);
  try {
    ready_folder();
    if (!has_room(bytes)) return;
    AtomicFile file(setup_.folder / name);
    file.write(ByteWriter().text(digest_of(call, key, facts, kept)).text(call).take());
    write_result(key, facts, kept, [&](std::string_view piece) { file.write(piece); });
    file.commit(Durable::yes);
    wait_for_disk(setup_.folder);
    used_.insert(name);
    ++counts_.kept;
  } catch (const Error& error) {
    note("write", not_kept(error));
  }
}

void ResultFiles::keep_in_log(const std::string& name, const std::string& bytes) {
  try {
    {
      const std::lock_guard lock(mutex_);
      if (!ready_for_log_) ready_folder();
      ready_for_log_ = true;  // the log restores missing folders
      if (!has_room(static_cast<std::int64_t>(bytes.size()) + ResultLog::bytes_beside)) return;
    }
    const fs::path file = logs_.front().keep(name, bytes);  // may wait for the disk: no lock
    const std::lock_guard lock(mutex_);
    if (file != log_file_) used_.insert(file.lexically_relative(setup_.folder).string());
    log_file_ = file;
    ++counts_.kept;
  } catch (const Error& error) {
    const std::lock_guard lock(mutex_);
    note("write", not_kept(error));
  }
}

void ResultFiles::bring_to_disk() {
  try {
    logs_.front().wait_for_disk();
  } catch (const Error& error) {
    const std::lock_guard lock(mutex_);
    note("write", not_kept(error));
  }
}

void ResultFiles::ready_folder() {
  std::error_code problem;
  fs::create_directory(setup_.folder, problem);
  if (problem)
    refuse_bad_file("cannot make the folder " + quoted(setup_.folder.string()) + ": " + problem.message());
  if (needed_on_disk_) return;
  for (const fs::path& file : setup_.needed) wait_for_disk(file);
  needed_on_disk_ = true;
}

bool ResultFiles::takes(std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  return make_room(bytes);
}

bool ResultFiles::has_room(std::int64_t bytes) {
  if (make_room(bytes)) return true;
  const bool shared = setup_.most_added - added_ < bytes;
  note("room",
       "results of this run exceed the " + format_bytes(shared ? setup_.most_added : setup_.most_bytes) +
           (shared ? " that it may add to its store" : " of its store") +
           ": some are computed again on --resume (" + (shared ? "--limit-disk" : "--store-limit") + ")");
  return false;
}

// Scans the folder after a quarter of its free room was used, because others write there. A full folder loses
// a sixteenth of its limit at once: a scan per result would cost n².
bool ResultFiles::make_room(std::int64_t bytes) {
  if (bytes > setup_.most_bytes || bytes > setup_.most_added - added_) return false;
  if (setup_.most_bytes == unlimited || added_since_ + bytes <= room_ / 4) {
    added_since_ += bytes;
    added_ += bytes;
    return true;
  }
  struct Old {
    fs::file_time_type used;
    fs::path file;
    std::int64_t bytes;
  };
  std::vector<Old> old;
  std::int64_t held = 0;
  const auto go_through = [&](const fs::path& folder, std::string_view extension) {
    std::error_code problem;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
      std::error_code gone;  // another run may remove it
      if (entry->path().extension() != extension) continue;
      const auto size = static_cast<std::int64_t>(entry->file_size(gone));
      if (gone) continue;
      held += size;
      if (is_part(entry->path())) continue;  // being written
      if (!used_.contains(entry->path().lexically_relative(setup_.folder).string()))
        old.push_back({entry->last_write_time(gone), entry->path(), size});
    }
  };
  go_through(setup_.folder, file_ending);
  go_through(setup_.folder / ResultLog::folder_name, ".results");
  std::ranges::sort(old, {}, &Old::used);
  const std::int64_t spare = held + bytes > setup_.most_bytes ? setup_.most_bytes / 16 : 0;
  for (const Old& file : old) {
    if (held + bytes + spare <= setup_.most_bytes) break;
    std::error_code problem;
    if (fs::remove(file.file, problem)) held -= file.bytes;
  }
  if (held + bytes > setup_.most_bytes) return false;
  room_ = setup_.most_bytes - held;
  added_since_ = bytes;
  added_ += bytes;
  return true;
}

void ResultFiles::note(std::string_view about, std::string sentence) {
  if (std::ranges::none_of(notices_, [&](const auto& notice) { return notice.first == about; }))
    notices_.emplace_back(about, std::move(sentence));
}

std::vector<std::string> ResultFiles::notices() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> sentences;
  for (const auto& notice : notices_) sentences.push_back(notice.second);
  return sentences;
}

ResultFiles::Counts ResultFiles::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::optional<FoundResult> ResultMemory::find(const std::string& key) {
  std::shared_ptr<const FoundResult> known;
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = places_.find(key); at != places_.end()) {
      entries_.splice(entries_.begin(), entries_, at->second);
      known = at->second->result;
      ++counts_.found;
    }
  }
  if (known != nullptr) {
    if (!has_room(bytes_of_result(key, *known))) clear();
    return *known;
  }
  std::optional<FoundResult> found = behind_ != nullptr ? behind_->find(key) : std::nullopt;
  if (!found) {
    const std::lock_guard lock(mutex_);
    ++counts_.missed;
    return {};
  }
  if (has_room(bytes_of_result(key, *found))) put(key, std::make_shared<const FoundResult>(*found));
  return found;
}

void ResultMemory::keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                        const KeptFields& fields) {
  std::int64_t bytes = 0;
  for (const auto& [name, field] : fields) bytes += static_cast<std::int64_t>(field->size() * sizeof(double));
  if (bytes <= most_bytes_ && has_room(bytes)) {
    FoundResult result;
    static_cast<ResultFacts&>(result) = facts;
    for (const auto& [name, field] : fields) result.fields.emplace_back(name, *field);
    put(key, std::make_shared<const FoundResult>(std::move(result)));
  } else if (bytes <= most_bytes_) {
    clear();  // as in find()
  }
  if (behind_ != nullptr) behind_->keep(key, call, facts, fields);
}

void ResultMemory::put(const std::string& key, std::shared_ptr<const FoundResult> result) {
  const std::int64_t bytes = bytes_of_result(key, *result);
  const std::lock_guard lock(mutex_);
  if (const auto at = places_.find(key); at != places_.end()) {
    counts_.bytes -= at->second->bytes;
    entries_.erase(at->second);
    places_.erase(at);
  }
  if (bytes > most_bytes_) return;
  while (counts_.bytes + bytes > most_bytes_) drop_last();
  entries_.push_front({key, std::move(result), bytes});
  places_.emplace(key, entries_.begin());
  counts_.bytes += bytes;
}

void ResultMemory::drop_last() {
  counts_.bytes -= entries_.back().bytes;
  places_.erase(entries_.back().key);
  entries_.pop_back();
  ++counts_.dropped;
}

void ResultMemory::clear() {
  const std::lock_guard lock(mutex_);
  places_.clear();
  entries_.clear();
  counts_.bytes = 0;
}

ResultMemory::Counts ResultMemory::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace asperity
