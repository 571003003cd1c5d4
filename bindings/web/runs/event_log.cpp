// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/event_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/files/disk.hpp"

namespace asperity::web {

bool EventLog::append(const std::string& type, const Json& fields) {
  if (finished_) return false;
  if (writer_.get() < 0)
    writer_ = Descriptor(::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  Json event = Json::object({{"n", static_cast<std::int64_t>(ends_.size()) + 1}, {"type", type}});
  for (const auto& [name, value] : fields.members())
    if (name != "n" && name != "type") event.set(name, value);
  const std::string line = event.text() + "\n";
  const std::int64_t begin = ends_.empty() ? 0 : ends_.back();
  if (writer_.get() < 0 || write_all(writer_.get(), line) != 0) {
    if (writer_.get() >= 0 && ::ftruncate(writer_.get(), begin) != 0) finished_ = true;
    return false;
  }
  ends_.push_back(begin + static_cast<std::int64_t>(line.size()));
  changed_.notify_all();
  return true;
}

bool EventLog::add(const std::string& type, const Json& fields) {
  const std::lock_guard lock(mutex_);
  return append(type, fields);
}

void EventLog::finish(const Json& fields) {
  const std::lock_guard lock(mutex_);
  append("finished", fields);
  finished_ = true;
  writer_.reset();
  changed_.notify_all();
}

std::string EventLog::after(std::int64_t& after, std::chrono::milliseconds patience, bool& more) const {
  constexpr std::int64_t piece = std::int64_t{64} << 10;
  std::int64_t begin = 0, end = 0;
  {
    std::unique_lock lock(mutex_);
    const auto known = [&] { return static_cast<std::int64_t>(ends_.size()); };
    changed_.wait_for(lock, patience, [&] { return finished_ || known() > after; });
    after = std::max<std::int64_t>(after, 0);
    if (known() > after) {
      begin = after == 0 ? 0 : ends_[static_cast<std::size_t>(after) - 1];
      end = ends_[static_cast<std::size_t>(after)];
      for (++after; after < known() && ends_[static_cast<std::size_t>(after)] - begin <= piece; ++after)
        end = ends_[static_cast<std::size_t>(after)];
    }
    more = !(finished_ && after >= known());
  }
  std::string text(static_cast<std::size_t>(end - begin), '\0');
  if (text.empty()) return text;
  const Descriptor reader(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
  if (reader.get() < 0 || ::lseek(reader.get(), begin, SEEK_SET) < 0 ||
      !read_whole(reader.get(), text.data(), text.size())) {
    more = false;
    return {};
  }
  return text;
}

std::int64_t EventLog::bytes() const {
  const std::lock_guard lock(mutex_);
  return ends_.empty() ? 0 : ends_.back();
}

}  // namespace asperity::web
