// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/patient_lock.hpp"
#include "engine/experiment/aside_file.hpp"

namespace asperity {

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_file_error("begin", path_, errno);
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::int64_t Journal::write(std::string_view event, const Json& fields) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorCode::bad_state, "the run is over; its journal takes no more events");
  return append(event, fields);
}

std::int64_t Journal::append(std::string_view event, const Json& fields) {
  if (descriptor_ >= 0) {
    Json line;
    line.set("n", count_ + 1);
    line.set("event", event);
    if (!fields.is_null())
      for (const auto& [name, value] : fields.members()) line.set(name, value);
    append_whole(descriptor_, line.text() + "\n", path_);
  }
  return ++count_;
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

}  // namespace asperity
