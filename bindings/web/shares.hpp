// SPDX-License-Identifier: GPL-3.0-or-later
// What one person may hold of something that all share, so that nobody takes it all.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace asperity::web {

// Thread-safe.
class Shares {
 public:
  // At most `each` for one person and `all` together.
  Shares(int each, int all) : state_(std::make_shared<State>()), each_(each), all_(all) {}

  // Held until the last copy of it is gone; waits so long for one, and is null where there was none.
  std::shared_ptr<void> take(std::size_t person, std::chrono::milliseconds patience) {
    std::unique_lock lock(state_->mutex);
    const auto free = [&] { return state_->held < all_ && state_->of[person] < each_; };
    if (!state_->changed.wait_for(lock, patience, free)) return nullptr;
    ++state_->held;
    ++state_->of[person];
    return {state_.get(), [state = state_, person](void*) {
              const std::lock_guard giving_back(state->mutex);
              --state->held;
              --state->of[person];
              state->changed.notify_all();
            }};
  }

 private:
  struct State {
    std::mutex mutex;
    std::condition_variable changed;
    int held = 0;
    std::map<std::size_t, int> of;
  };
  std::shared_ptr<State> state_;
  int each_, all_;
};

}  // namespace asperity::web
