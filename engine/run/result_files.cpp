// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/result_files.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view numbers = "numbers/", fields = "fields/", spent = "cost/";
constexpr std::string_view form = "asperity result 1";

std::string digest_of(const std::string& key, const Hdf5Content& content) {
  Digester digester;
  digester.add(form).add(key);
  for (const auto& [name, text] : content.texts)
    if (name != "digest") digester.add(name).add(text);
  for (const Hdf5Array& array : content.arrays) {
    digester.add(array.name);
    for (const std::size_t length : array.shape) digester.add(static_cast<std::int64_t>(length));
    digester.add(std::get<std::span<const double>>(array.values));
  }
  return digester.hex();
}

void sort_by_name(Hdf5Content& content) {
  std::ranges::sort(content.arrays, {}, &Hdf5Array::name);
  std::ranges::sort(content.texts);
}

Hdf5Array number_array(std::string_view group, std::string_view name, double value, std::string unit = {}) {
  return owning_array(std::string(group) + std::string(name), {}, Array<double>(1, value), std::move(unit));
}

std::string not_kept(const Error& error) {
  return "a result could not be kept and would be computed again if the run were resumed: " +
         std::string(error.what());
}

[[noreturn]] void damaged(const fs::path& file, const std::string& what) {
  throw Error(ErrorCode::bad_file, quoted(file.string()) + " " + what);
}

}  // namespace

ResultFiles::ResultFiles(ResultFilesSetup setup)
    : setup_(std::move(setup)),
      log_(setup_.folder / ResultLog::folder_name, [this](const std::string& file, std::string sentence) {
        const std::lock_guard lock(mutex_);
        note(file, std::move(sentence));
      }) {
  // Another run may be writing.
  sweep_parts(setup_.folder, Parts::abandoned);
  for (const fs::path& folder : setup_.also)
    other_logs_.emplace_back(folder / ResultLog::folder_name,
                             [this](const std::string& file, std::string sentence) {
                               const std::lock_guard lock(mutex_);
                               note(file, std::move(sentence));
                             });
}

std::string ResultFiles::name_of(const std::string& key) const {
  return Digester().add(form).add(setup_.build).add(key).hex();
}

// Called without the lock, which notices of a log take.
std::optional<FoundResult> ResultFiles::find_in_logs(const std::string& key, const std::string& name) {
  std::optional<ResultLog::Found> record = log_.find(name);
  const bool own = record.has_value();
  for (std::size_t k = 0; !record && k < other_logs_.size(); ++k) record = other_logs_[k].find(name);
  if (!record) return {};
  std::optional<FoundResult> found;
  try {
    ByteReader in(record->bytes);
    if (in.text() != key) return {};
    found = result_from(in);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    return {};  // intact, but of another key
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
  const std::string stem = name_of(key), name = stem + ".h5";
  if (std::optional<FoundResult> found = find_in_logs(key, stem)) return found;
  std::vector<fs::path> folders = {setup_.folder};
  folders.insert(folders.end(), setup_.also.begin(), setup_.also.end());
  for (const fs::path& folder : folders) {
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
    Hdf5Content content = read_hdf5(file);
    sort_by_name(content);
    const std::string* digest = content.text("digest");
    for (const Hdf5Array& array : content.arrays)
      if (!std::holds_alternative<std::span<const double>>(array.values) || array.shape.size() > 2)
        damaged(file, "holds " + quoted(array.name) + ", which is no part of a result");
    if (digest == nullptr || *digest != digest_of(key, content))
      damaged(file, "is not what was written: a kept result was altered");
    FoundResult found;
    for (const auto& [name, text] : content.texts)
      if (name.starts_with("text ")) found.texts.emplace_back(name.substr(5), text);
    for (const Hdf5Array& array : content.arrays) {
      const auto values = std::get<std::span<const double>>(array.values);
      if (array.name.starts_with(numbers)) {
        found.numbers.emplace_back(array.name.substr(numbers.size()), values.front());
      } else if (array.name.starts_with(fields)) {
        Field field(static_cast<int>(array.shape.at(1)), static_cast<int>(array.shape.at(0)));
        std::ranges::copy(values, field.values().begin());
        found.fields.emplace_back(array.name.substr(fields.size()), std::move(field));
      }
    }
    found.cost.seconds = std::get<std::span<const double>>(content.array("cost/seconds")->values).front();
    found.cost.transforms =
        std::get<std::span<const double>>(content.array("cost/transforms")->values).front();
    found.cost.bytes = static_cast<std::int64_t>(
        std::get<std::span<const double>>(content.array("cost/bytes")->values).front());
    return found;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    const std::lock_guard lock(mutex_);
    note(file.string(), error.sentence() + "; it was computed again");
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
    AtomicFile copy(to);  // other runs may copy it, too
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
  Hdf5Content content;
  content.texts = {{"form", std::string(form)}, {"call", std::string(call)}, {"key", key}};
  for (const auto& [name, text] : facts.texts) content.texts.emplace_back("text " + name, text);
  for (const auto& [name, value] : facts.numbers)
    content.arrays.push_back(number_array(numbers, name, value));
  content.arrays.push_back(number_array(spent, "seconds", facts.cost.seconds, "s"));
  content.arrays.push_back(number_array(spent, "transforms", facts.cost.transforms));
  content.arrays.push_back(number_array(spent, "bytes", static_cast<double>(facts.cost.bytes), "byte"));
  std::int64_t bytes = 4096;
  for (const auto& [name, field] : kept) {
    content.arrays.push_back({std::string(fields) + name,
                              {static_cast<std::size_t>(field->ny()), static_cast<std::size_t>(field->nx())},
                              field->values(),
                              ""});
    bytes += static_cast<std::int64_t>(field->size() * sizeof(double));
  }
  sort_by_name(content);
  content.texts.emplace_back("digest", digest_of(key, content));
  const std::string name = name_of(key) + ".h5";
  const std::lock_guard lock(mutex_);
  try {
    ready_folder();
    if (!has_room(bytes)) return;
    write_hdf5(setup_.folder / name, content);
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
    const fs::path file = log_.keep(name, bytes);  // may wait for the disk: no lock
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
    log_.wait_for_disk();
  } catch (const Error& error) {
    const std::lock_guard lock(mutex_);
    note("write", not_kept(error));
  }
}

void ResultFiles::ready_folder() {
  std::error_code problem;
  fs::create_directory(setup_.folder, problem);
  if (problem)
    throw Error(ErrorCode::bad_file,
                "cannot make the folder " + quoted(setup_.folder.string()) + ": " + problem.message());
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
  note("room", "results of this run no longer fit the " +
                   format_bytes(shared ? setup_.most_added : setup_.most_bytes) +
                   (shared ? " that it may add to its store" : " of its store") +
                   ": some would be computed again if it were resumed (" +
                   (shared ? "--limit-disk" : "--store-limit") + ")");
  return false;
}

// Scans the folder after a quarter of its free room was used, because others write there. A full folder loses
// a sixteenth of its limit at once: a scan for each of n results would cost n².
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
  go_through(setup_.folder, ".h5");
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

}  // namespace asperity
