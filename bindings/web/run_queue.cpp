// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/run_queue.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

RunQueue::RunQueue(QueueSetup setup) : setup_(std::move(setup)) {
  for (int k = 0; k < setup_.at_once; ++k) workers_.emplace_back([this] { work(); });
}

RunQueue::~RunQueue() { close(); }

std::shared_ptr<PageRun> RunQueue::add(std::size_t owner, RunRequest request) {
  const std::lock_guard lock(mutex_);
  const auto refuse = [](const std::string& sentence, const std::string& hint) {
    throw Error(ErrorCode::bad_state, sentence, hint);
  };
  if (over_) refuse("the server is being stopped", "");
  auto& own = waiting_[owner];
  if (own.size() >= setup_.most_waiting_of_one || waiting_in_all_ >= setup_.most_waiting)
    refuse("as many runs wait as may: " +
               std::to_string(own.size() >= setup_.most_waiting_of_one ? own.size() : waiting_in_all_),
           "wait until one has ended, or stop one");
  std::int64_t kept = 0;
  for (const auto& [id, run] : runs_)
    if (run->owner == owner) kept += run->bytes();
  if (kept > setup_.most_bytes_of_one || runs_.size() >= setup_.most_kept)
    refuse("the runs of this session take " + format_short(static_cast<double>(kept) / 0x1p20) + " MiB in " +
               std::to_string(runs_.size()) + " folders, and there may be no more",
           "start `asperity serve` again: what was recorded stays in " + setup_.folder.string());
  const std::string id = std::to_string(++last_id_);
  auto run = std::make_shared<PageRun>(id, owner, std::move(request), setup_.folder / id);
  runs_.emplace(id, run);
  own.push_back(run);
  ++waiting_in_all_;
  changed_.notify_one();
  return run;
}

std::shared_ptr<PageRun> RunQueue::find(std::size_t owner, const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = runs_.find(id);
  return found == runs_.end() || found->second->owner != owner ? nullptr : found->second;
}

std::vector<std::shared_ptr<PageRun>> RunQueue::of(std::size_t owner) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<PageRun>> own;
  for (const auto& [id, run] : runs_)
    if (run->owner == owner) own.push_back(run);
  std::ranges::sort(own, {}, [](const auto& run) { return std::stoll(run->id); });
  return own;
}

void RunQueue::stop(PageRun& run) {
  run.stop();
  const std::lock_guard lock(mutex_);
  auto& own = waiting_[run.owner];
  const auto waits = std::ranges::find(own, run.id, [](const auto& other) { return other->id; });
  if (waits == own.end()) return;
  (*waits)->give_up(RunState::stopped, "it was stopped before it began");
  own.erase(waits);
  --waiting_in_all_;
}

// The next of whoever comes after the one who was served last.
std::shared_ptr<PageRun> RunQueue::next() {
  auto at = waiting_.upper_bound(last_served_);
  for (std::size_t k = 0; k <= waiting_.size(); ++k, ++at) {
    if (at == waiting_.end()) at = waiting_.begin();
    if (at->second.empty()) continue;
    auto run = at->second.front();
    at->second.pop_front();
    --waiting_in_all_;
    last_served_ = at->first;
    return run;
  }
  return nullptr;
}

void RunQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return over_ || waiting_in_all_ > 0; });
    if (over_) return;
    const auto run = next();
    lock.unlock();
    if (run != nullptr) run->go(setup_.limits, setup_.barriers);
    lock.lock();
  }
}

void RunQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    for (auto& [owner, own] : waiting_)
      for (const auto& run : own) run->give_up(RunState::stopped, "the server was stopped before it began");
    waiting_.clear();
    waiting_in_all_ = 0;
    for (const auto& [id, run] : runs_) run->stop();
    changed_.notify_all();
  }
  for (std::thread& worker : workers_)
    if (worker.joinable()) worker.join();
}

}  // namespace asperity::web
