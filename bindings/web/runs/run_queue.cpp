// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/run_queue.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/require.hpp"

namespace asperity::web {

namespace {

constexpr std::int64_t least_bytes = std::int64_t{1} << 20;  // least free space
constexpr std::size_t told_places = 3;                       // per person, with a reported place

}  // namespace

RunQueue::RunQueue(QueueSetup setup)
    : setup_(std::move(setup)),
      turns_({.places = setup_.at_once,
              .each = setup_.shared ? std::max(1, setup_.at_once - 1) : setup_.at_once,
              .one_while_others_wait = setup_.shared}) {
  for (int k = 0; k < setup_.at_once; ++k) workers_.emplace_back([this] { work(); });
}

RunQueue::~RunQueue() { close(); }

std::shared_ptr<PageRun> RunQueue::add(std::size_t owner, RunRequest request) {
  const std::lock_guard lock(mutex_);
  if (over_) refuse_state("the server is being stopped");
  auto& own = waiting_[owner];
  if (own.size() >= setup_.most_waiting_of_one || waiting_in_all_ >= setup_.most_waiting)
    refuse_state("too many runs wait: " +
                     std::to_string(own.size() >= setup_.most_waiting_of_one ? own.size() : waiting_in_all_),
                 "wait until one has ended, or stop one");
  const std::int64_t kept = kept_by(owner);
  if (kept > setup_.most_bytes_of_one || runs_.size() >= setup_.most_kept)
    refuse_state("the runs of this session take " + format_short(static_cast<double>(kept) / 0x1p20) +
                     " MiB in " + std::to_string(runs_.size()) + " folders, their limit",
                 "start `asperity serve` again: the records stay in " + setup_.folder.string());
  const std::string id = std::to_string(++last_id_);
  auto run = std::make_shared<PageRun>(id, owner, std::move(request), setup_.folder / id);
  runs_.emplace(id, run);
  own.push_back(run);
  ++waiting_in_all_;
  changed_.notify_one();
  tell_places();
  return run;
}

std::shared_ptr<PageRun> RunQueue::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = runs_.find(id);
  return found == runs_.end() ? nullptr : found->second;
}

std::vector<std::shared_ptr<PageRun>> RunQueue::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<PageRun>> all;
  for (const auto& [id, run] : runs_) all.push_back(run);
  std::ranges::sort(all, {}, [](const auto& run) { return std::stoll(run->id); });
  return all;
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
  tell_places();
}

std::vector<std::size_t> RunQueue::people_waiting() const {
  std::vector<std::size_t> people;
  for (const auto& [owner, own] : waiting_)
    if (!own.empty()) people.push_back(owner);
  return people;
}

std::shared_ptr<PageRun> RunQueue::next() {
  const auto owner = turns_.next(people_waiting(), std::chrono::steady_clock::now());
  if (!owner) return nullptr;
  auto& own = waiting_[*owner];
  auto run = own.front();
  own.pop_front();
  --waiting_in_all_;
  return run;
}

std::int64_t RunQueue::kept_by(std::size_t owner) const {
  std::int64_t kept = 0;
  for (const auto& [id, run] : runs_) {
    if (run->owner != owner) continue;
    const auto granted = granted_.find(id);
    kept += granted == granted_.end() ? run->bytes() : granted->second;
  }
  return kept;
}

// Approximate runs ahead of each.
void RunQueue::tell_places() {
  // If a run begins at once, report afterwards.
  const bool place_free = granted_.size() < static_cast<std::size_t>(setup_.at_once);
  if (place_free && turns_.next(people_waiting(), std::chrono::steady_clock::now())) return;
  for (auto& [owner, own] : waiting_)
    for (std::size_t k = 0; k < std::min(own.size(), told_places); ++k) {
      std::size_t before = k;
      for (const auto& [other, others] : waiting_)
        if (other != owner) before += std::min(others.size(), k + (other < owner ? 1 : 0));
      own[k]->tell_place(before);
    }
}

void RunQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::shared_ptr<PageRun> run;
    changed_.wait(lock, [&] { return over_ || (run = next()) != nullptr; });
    if (over_) return;
    // The disk may have filled meanwhile.
    RunLimits limits = setup_.limits;
    const std::int64_t left = setup_.most_bytes_of_one - kept_by(run->owner) - limits.event_bytes;
    if (left < least_bytes) {
      run->give_up(RunState::limit,
                   "the runs of this session fill their share of the disk: it was not begun");
      continue;
    }
    limits.directory_bytes = std::min(limits.directory_bytes, left);
    granted_[run->id] = limits.directory_bytes + limits.event_bytes;
    const auto begun = std::chrono::steady_clock::now();
    turns_.begin(run->owner, begun);
    tell_places();
    lock.unlock();
    run->go(limits, setup_.barriers);
    lock.lock();
    turns_.end(run->owner, begun, run->processor_seconds(), std::chrono::steady_clock::now());
    granted_.erase(run->id);
    changed_.notify_all();
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
