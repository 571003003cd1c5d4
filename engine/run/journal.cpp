// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity {

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_file_error("begin", path_, errno);
}

std::unique_ptr<Journal> Journal::again(std::filesystem::path path) {
  // O_NOFOLLOW refuses a link before the first read.
  auto journal = std::make_unique<Journal>();
  const auto opened = [&] {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0 && errno == ELOOP) throw_link(path);
    if (descriptor < 0) throw_file_error("take up", path, errno);
    return descriptor;
  };
  ::close(opened());
  // A copy by hard links (cp -al) must keep its bytes.
  part_from_other_names(path);
  journal->descriptor_ = opened();
  JournalLines recorded = read_journal(path, true);
  if (!recorded.lines.empty() && recorded.lines.back()["event"] == Json("end")) {
    recorded.lines.pop_back();
    recorded.ends.pop_back();
  }
  if (::ftruncate(journal->descriptor_, recorded.ends.empty() ? 0 : recorded.ends.back()) != 0)
    throw_file_error("take up", path, errno);
  journal->path_ = std::move(path);
  journal->recorded_ = std::move(recorded.lines);
  journal->ends_ = std::move(recorded.ends);
  return journal;
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::int64_t Journal::write(std::string_view event, const Json& fields) {
  const std::lock_guard lock(mutex_);
  if (closed_) refuse_state("the run is over; its journal takes no more events");
  return append(event, fields);
}

std::int64_t Journal::append(std::string_view event, const Json& fields) {
  if (descriptor_ >= 0) {
    Json line;
    line.set("n", count_ + 1);
    line.set("event", event);
    if (!fields.is_null())
      for (const auto& [name, value] : fields.members()) line.set(name, value);
    if (!repeats(line)) append_whole(descriptor_, line.text() + "\n", path_);
    digester_.add(without(line).text());
  }
  ++count_;
  if (watcher_) watcher_(event, fields);
  return count_;
}

bool Journal::repeats(const Json& line) {
  const auto at = static_cast<std::size_t>(count_);
  if (at >= recorded_.size()) return false;
  const Json& recorded = recorded_[at];
  const Json now = without(Json::parse(line.text(), "a line of the journal"));
  if (now == recorded) return true;
  const DifferingMember differs = differing_members(&recorded, &now).front();
  const std::string where = "line " + std::to_string(count_ + 1) + " of the journal";
  const std::string what =
      quoted(differs.path) + " was " + brief(differs.one) + " and is now " + brief(differs.other);
  for (const char* part : {"event", "function", "self", "inputs", "notebook", "script", "digest", "seed"}) {
    if (recorded[part] == now[part]) continue;
    refuse_state("the run differs from the resumed one: in " + where + " " + what,
                 "its inputs have changed; run the script again, with --reuse for unchanged results");
  }
  departure_ = "from " + where + " on it is written again: " + what;
  if (::ftruncate(descriptor_, at == 0 ? 0 : ends_[at - 1]) != 0) throw_file_error("take up", path_, errno);
  recorded_.clear();
  return false;
}

std::string Journal::departure() const {
  const std::lock_guard lock(mutex_);
  return departure_;
}

bool Journal::repeating() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(count_) < recorded_.size();
}

std::int64_t Journal::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

bool Journal::close(std::string_view event, const Json& fields, std::chrono::milliseconds patience) {
  const std::unique_lock lock = lock_within(mutex_, patience);
  if (!lock.owns_lock()) return false;
  if (closed_) return true;
  closed_ = true;
  append(event, fields);
  return true;
}

bool Journal::is_lost() const {
  struct ::stat held {
  }, named{};
  if (descriptor_ < 0 || ::fstat(descriptor_, &held) != 0) return false;
  return held.st_nlink == 0 || ::lstat(path_.c_str(), &named) != 0 || named.st_ino != held.st_ino ||
         named.st_dev != held.st_dev;
}

std::optional<JournalFacts> Journal::facts() const {
  const std::unique_lock lock = lock_within(mutex_, std::chrono::milliseconds(100));
  if (!lock.owns_lock() || !closed_ || descriptor_ < 0) return {};
  return JournalFacts{count_, digester_.hex()};
}

bool Journal::is_altered() const {
  const std::optional<JournalFacts> written = facts();
  try {
    return written && facts_of(read_journal(path_, false).lines) != *written;
  } catch (const Error&) {
    return true;
  }
}

JournalFacts facts_of(const std::vector<Json>& lines) {
  Digester digester;
  for (const Json& line : lines) digester.add(line.text());
  return {static_cast<std::int64_t>(lines.size()), digester.hex()};
}

Json without(const Json& record, std::string_view name) {
  Json::Members kept;
  for (const Json::Member& member : record.members())
    if (member.first != name) kept.push_back(member);
  return Json::object(std::move(kept));
}

namespace {

// Heavy results have their own digests.
std::string results_remain(const std::filesystem::path& journal) {
  const std::string run = journal.parent_path().string();
  return "use its results by `asperity run " + (journal.parent_path() / "script.lua").string() + " --reuse " +
         run + "`";
}

}  // namespace

JournalLines read_journal(const std::filesystem::path& path, bool may_be_torn) {
  const std::string text = text_of_run_file(path);
  JournalLines read;
  std::int64_t bytes = 0;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::string name = "line " + std::to_string(read.lines.size() + 1) + " of " + quoted(path.string());
    // No newline, or a hole from a power cut.
    if (may_be_torn && (end == text.size() || line.find('\0') != std::string::npos)) break;
    bytes += static_cast<std::int64_t>(line.size()) + 1;
    if (line.find('\0') != std::string::npos)
      refuse_bad_file(name + " holds zeros, as a power cut leaves them", results_remain(path));
    Json record = Json::parse(line, name);
    const Json* number = record.find("n");
    if (number == nullptr || number->number() != static_cast<double>(read.lines.size() + 1))
      refuse_bad_file(name + " has a wrong number", "the journal was altered; " + results_remain(path));
    read.lines.push_back(without(record));
    read.ends.push_back(bytes);
  }
  return read;
}

std::string brief(const Json* value) {
  if (value == nullptr) return "nothing";
  std::string text = value->text();
  constexpr std::size_t longest = 120;
  if (text.size() > longest) text = text.substr(0, longest) + " …";
  return text;
}

std::vector<DifferingMember> differing_members(const Json* one, const Json* other, const std::string& path) {
  std::vector<DifferingMember> all;
  if (one == nullptr || other == nullptr || !one->is_object() || !other->is_object())
    return {{path, one, other}};
  const auto under = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  for (const auto& [name, value] : one->members()) {
    const Json* same = other->find(name);
    if (same != nullptr && *same == value) continue;
    for (DifferingMember& member : differing_members(&value, same, under(name)))
      all.push_back(std::move(member));
  }
  for (const auto& [name, value] : other->members())
    if (one->find(name) == nullptr) all.push_back({under(name), nullptr, &value});
  if (all.empty()) all.push_back({path, one, other});  // only the order differs
  return all;
}

}  // namespace asperity
