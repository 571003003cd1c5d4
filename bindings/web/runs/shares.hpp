// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds each person's share of a resource. People are served in order of arrival; some shares can be
// reserved for quick users.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace asperity::web {

// Thread-safe.
class Shares {
 public:
  // At most `each` for a person and `all` together; `for_quick` only for people whose last use took at most
  // `quick`.
  Shares(int each, int all, int for_quick = 0,
         std::chrono::milliseconds quick = std::chrono::milliseconds(1000))
      : state_(std::make_shared<State>()) {
    state_->each = each;
    state_->all = all;
    state_->for_quick = for_quick;
    state_->quick = quick;
  }

  // Null after `patience`. Held until the last copy is destroyed.
  std::shared_ptr<void> take(std::size_t person, std::chrono::milliseconds patience) {
    std::unique_lock lock(state_->mutex);
    const auto place = state_->waiting.insert(state_->waiting.end(), person);
    const bool served = state_->changed.wait_for(lock, patience, [&] { return state_->is_next(place); });
    state_->waiting.erase(place);
    // The next in line may be served, too.
    state_->changed.notify_all();
    if (!served) return nullptr;
    const bool slow = state_->of[person].slow;
    ++state_->held;
    if (slow) ++state_->held_by_slow;
    ++state_->of[person].held;
    return {state_.get(), [state = state_, person, slow, begun = Clock::now()](void*) {
              const std::lock_guard giving_back(state->mutex);
              --state->held;
              if (slow) --state->held_by_slow;
              --state->of[person].held;
              state->of[person].slow = Clock::now() - begun > state->quick;
              state->changed.notify_all();
            }};
  }

  std::size_t waiting() const {
    const std::lock_guard lock(state_->mutex);
    return state_->waiting.size();
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Person {
    int held = 0;
    bool slow = false;
  };
  struct State {
    bool can_take(std::size_t person) {
      return held < all && of[person].held < each && (!of[person].slow || held_by_slow < all - for_quick);
    }
    bool is_next(std::list<std::size_t>::iterator place) {
      for (auto at = waiting.begin(); at != waiting.end(); ++at)
        if (can_take(*at)) return at == place;
      return false;
    }
    std::mutex mutex;
    std::condition_variable changed;
    int each = 1, all = 1, for_quick = 0;
    std::chrono::milliseconds quick{};
    int held = 0, held_by_slow = 0;
    std::map<std::size_t, Person> of;
    std::list<std::size_t> waiting;
  };
  std::shared_ptr<State> state_;
};

}  // namespace asperity::web
