// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/laws_met.hpp"

#include <utility>

namespace asperity {

namespace {
thread_local bool unheard = false;
}

LawsUnheard::LawsUnheard() : outer_(std::exchange(unheard, true)) {}
LawsUnheard::~LawsUnheard() { unheard = outer_; }

void LawsMet::follow(std::function<std::int64_t()> line) {
  const std::lock_guard lock(mutex_);
  line_ = std::move(line);
  lines_.fill(0);
  followed_ = line_ != nullptr;
}

std::int64_t LawsMet::first_line(Law law) const {
  const std::lock_guard lock(mutex_);
  return lines_[static_cast<std::size_t>(law)];
}

void LawsMet::keep(Law law) {
  if (unheard) return;
  const std::lock_guard lock(mutex_);
  std::int64_t& line = lines_[static_cast<std::size_t>(law)];
  if (line == 0 && line_) line = line_();
}

LawsMet& laws_met() {
  static LawsMet of_process;
  return of_process;
}

}  // namespace asperity
