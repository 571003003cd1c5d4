// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/shared_scripts.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace asperity::web {

void SharedScripts::hand(std::optional<SharedScript> script) {
  using std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::lock_guard lock(mutex_);
  const std::int64_t clock = std::chrono::duration_cast<milliseconds>(now).count();
  handed_ = {std::max<std::int64_t>(handed_.number + 1, clock), std::move(script)};
}

SharedScripts::Handed SharedScripts::handed() const {
  const std::lock_guard lock(mutex_);
  return handed_;
}

void SharedScripts::show(std::size_t person, std::optional<SharedScript> script) {
  const std::lock_guard lock(mutex_);
  if (script)
    shown_[person] = *std::move(script);
  else
    shown_.erase(person);
}

std::optional<SharedScript> SharedScripts::shown_by(std::size_t person) const {
  const std::lock_guard lock(mutex_);
  const auto found = shown_.find(person);
  return found == shown_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace asperity::web
