// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/case_scheduler.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>

#include "engine/core/cost.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/byte_string.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"
#include "engine/run/ranks.hpp"

namespace asperity {

namespace {

constexpr auto look_every = std::chrono::milliseconds(20);
constexpr auto exchange_every = std::chrono::milliseconds(1);

using Finished = EnsembleCases::Finished;

class CaseScheduler {
 public:
  CaseScheduler(EnsembleCases& cases, const CaseSchedule& schedule)
      : cases_(cases),
        schedule_(schedule),
        ranks_(schedule.ranks),
        results_(cases.count()),
        finished_(cases.count(), false) {
    for (std::size_t k = 0; k < cases.count(); ++k)
      if (!follows() && (!schedule.own || schedule.own(k))) waiting_.push_back(k);
    wanted_ = follows() ? cases.count() : waiting_.size();
    if (ranks_ == nullptr) return;
    open_ = true;
    given_.resize(static_cast<std::size_t>(ranks_->size()));
    idle_.resize(static_cast<std::size_t>(ranks_->size()));
    Digester digester;
    for (std::size_t k = 0; k < cases.count(); ++k) digester.add(cases_.name(k));
    name_ = std::to_string(schedule.ensemble) + " " + digester.hex();
  }

  std::vector<Finished> run() {
    const int threads = thread_count();
    const std::size_t wanted = std::min(wanted_, static_cast<std::size_t>(threads));
    // A single case may use all threads, unless nested.
    const bool single = wanted > 1 || threads == 1;
    {
      std::vector<std::jthread> workers;
      const Ending ending(*this);
      if (leads() || looks_first()) find_kept();
      if (looks_first()) schedule_.report({{waiting_.begin(), waiting_.end()}, {}});
      if (follows()) ranks_->send(0, Ranks::Kind::hello, ByteWriter().text(name_).count(wanted).take());
      start(workers, wanted, single);
      while (!look()) {
      }
    }
    stop_flag().check();
    if (leads()) ranks_->send_to_others(Ranks::Kind::rows, all_rows());
    if (schedule_.own) find_others();
    double transforms = 0;
    for (const Finished& result : results_) transforms += result->transforms;
    cost::count_transforms(transforms);
    return std::move(results_);
  }

 private:
  // On every exit path: no new case, then join the threads.
  struct Ending {
    explicit Ending(CaseScheduler& s) : scheduler(s) {}
    ~Ending() {
      const std::lock_guard lock(scheduler.mutex_);
      scheduler.waiting_.clear();
      scheduler.open_ = false;
      scheduler.more_.notify_all();
    }
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;
    CaseScheduler& scheduler;
  };

  void start(std::vector<std::jthread>& workers, std::size_t wanted, bool single) {
    working_ = wanted;
#if defined(__EMSCRIPTEN__)
    // Without threads. run() adds the transforms of the results.
    const double before = cost::transforms();
    if (wanted > 0) work(single);
    cost::count_transforms(before - cost::transforms());
#else
    for (std::size_t k = 0; k < wanted; ++k) try {
        workers.emplace_back([this, single] { work(single); });
      } catch (const std::system_error&) {
        const std::lock_guard lock(mutex_);
        working_ -= wanted - k;
        if (workers.empty()) throw Error(ErrorCode::out_of_memory, "no thread could be started");
        return;
      }
#endif
  }

  void work(bool single) {
    std::optional<SingleThreaded> alone;
    if (single) alone.emplace();
    while (stop_flag().reason() == StopReason::none) {
      const std::optional<std::size_t> k = next();
      if (!k) break;
      Finished result = result_of(*k);
      if (result == nullptr) break;
      const std::lock_guard lock(mutex_);
      finish(*k, std::move(result));
    }
    const std::lock_guard lock(mutex_);
    if (--working_ == 0) changed_.notify_all();
  }

  std::optional<std::size_t> next() {
    std::unique_lock lock(mutex_);
    while (waiting_.empty()) {
      if (!open_ || stop_flag().reason() != StopReason::none) return {};
      more_.wait_for(lock, look_every);
    }
    const std::size_t k = waiting_.front();
    waiting_.pop_front();
    return k;
  }

  // Null during a stop, which can falsify a case.
  Finished result_of(std::size_t k) {
    const auto stopped = [] { return stop_flag().reason() != StopReason::none; };
    try {
      if (Finished found = cases_.find_kept(k, false)) return found;
      Finished result = cases_.compute(k);
      if (stopped()) return nullptr;
      if (ranks_ != nullptr) require_bytes(k, *result);
      try {
        cases_.keep(k, *result, static_cast<bool>(schedule_.own));
      } catch (const Error& error) {
        // Other processes wait for a record: store a failure.
        cases_.fail(*result, error.what());
        cases_.keep(k, *result, true);
      }
      return result;
    } catch (const std::exception& error) {
      return stopped() ? nullptr : cases_.failed(error.what());
    }
  }

  // A row without serial form fails in every process.
  void require_bytes(std::size_t k, FinishedCase& result) {
    try {
      (void)cases_.bytes(k, result);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_permitted) throw;
      cases_.fail(result, error.what());
    }
  }

  // Requires the mutex.
  void finish(std::size_t k, Finished result) {
    if (follows()) {
      outbox_.emplace_back(k, std::move(result));
      changed_.notify_all();
      return;
    }
    if (!result->failure.empty()) ++failed_;
    results_[k] = std::move(result);
    finished_[k] = true;
    ++done_;
    if (leads() && done_ == results_.size()) {
      open_ = false;
      more_.notify_all();
    }
  }

  // --- with other ranks

  bool leads() const { return ranks_ != nullptr && ranks_->leads(); }
  bool follows() const { return ranks_ != nullptr && !ranks_->leads(); }

  bool looks_first() const { return schedule_.report && !schedule_.own && !follows(); }

  void find_kept() {
    const std::lock_guard lock(mutex_);
    std::deque<std::size_t> missing;
    for (const std::size_t k : std::exchange(waiting_, {}))
      if (Finished found = cases_.find_kept(k, false))
        finish(k, std::move(found));
      else
        missing.push_back(k);
    waiting_ = std::move(missing);
  }

  // Gives a rank up to `wanted` cases, some later if too few are waiting.
  void hand_out(int to, std::size_t wanted) {
    ByteWriter out;
    out.text(name_);
    {
      const std::lock_guard lock(mutex_);
      const std::size_t many = std::min(wanted, waiting_.size());
      idle_[static_cast<std::size_t>(to)] = wanted - many;
      if (many == 0) return;
      out.count(many);
      for (std::size_t n = 0; n < many; ++n) {
        out.count(waiting_.front());
        given_[static_cast<std::size_t>(to)].insert(waiting_.front());
        waiting_.pop_front();
      }
    }
    ranks_->send(to, Ranks::Kind::cases, out.take());
  }

  void lead() {
    while (const std::optional<Ranks::Message> message = ranks_->receive()) {
      const int from = message->from;
      auto& given = given_[static_cast<std::size_t>(from)];
      ByteReader in(message->bytes);
      const std::string name = in.text();
      if (message->kind == Ranks::Kind::end) {
        take_back(from, name.empty() ? "ended before rank 0" : "failed: " + name);
      } else if (message->kind == Ranks::Kind::here) {
        part_from(from, "reached " + name + " when rank 0 reached an ensemble");
      } else if (name != name_) {
        // A late message from a finished ensemble is ignored; a later ensemble means different scripts.
        if (std::stoll(name) < std::stoll(name_)) continue;
        part_from(from, "reached another ensemble than rank 0");
      } else if (message->kind == Ranks::Kind::hello) {
        hand_out(from, static_cast<std::size_t>(in.number<std::uint64_t>()));
      } else if (message->kind == Ranks::Kind::result) {
        const auto k = static_cast<std::size_t>(in.number<std::uint64_t>());
        if (given.erase(k) == 0) continue;
        Finished result = cases_.from_bytes(k, in.text());
        cases_.keep(k, *result, false);
        {
          const std::lock_guard lock(mutex_);
          finish(k, std::move(result));
        }
        hand_out(from, idle_[static_cast<std::size_t>(from)] + 1);
      }
    }
  }

  void take_back(int from, const std::string& why) {
    ranks_->lose(from, why);
    const std::lock_guard lock(mutex_);
    auto& given = given_[static_cast<std::size_t>(from)];
    waiting_.insert(waiting_.begin(), given.begin(), given.end());
    given.clear();
    more_.notify_all();
  }

  void part_from(int other, const std::string& why) {
    take_back(other, why + ": the script must do the same in every process");
    ranks_->send(other, Ranks::Kind::end, "");
  }

  std::string all_rows() const {
    ByteWriter out;
    out.text(name_);
    for (std::size_t k = 0; k < results_.size(); ++k) out.text(cases_.bytes(k, *results_[k]));
    return out.take();
  }

  void follow() {
    std::vector<std::pair<std::size_t, Finished>> finished;
    {
      const std::lock_guard lock(mutex_);
      finished.swap(outbox_);
    }
    for (const auto& [k, result] : finished)
      ranks_->send(0, Ranks::Kind::result,
                   ByteWriter().text(name_).count(k).text(cases_.bytes(k, *result)).take());
    while (std::optional<Ranks::Message> message = ranks_->receive()) {
      ByteReader in(message->bytes);
      if (message->kind == Ranks::Kind::end) {
        ranks_->put_back(*std::move(message));
        refuse_state("rank 0 has ended or takes another way");
      }
      if (message->kind != Ranks::Kind::cases && message->kind != Ranks::Kind::rows) continue;
      if (const std::string name = in.text(); name != name_) {
        if (std::stoll(name) < std::stoll(name_)) continue;
        refuse_state("rank 0 reached another ensemble: the script must do the same in every process");
      }
      const std::lock_guard lock(mutex_);
      if (message->kind == Ranks::Kind::cases) {
        for (auto left = in.number<std::uint64_t>(); left > 0; --left)
          waiting_.push_back(static_cast<std::size_t>(in.number<std::uint64_t>()));
      } else if (message->kind == Ranks::Kind::rows) {
        for (std::size_t k = 0; k < results_.size(); ++k) {
          results_[k] = cases_.from_bytes(k, in.text());
          finished_[k] = true;
        }
        waiting_.clear();
        open_ = false;
      }
      more_.notify_all();
      if (!open_) return;  // later messages belong to later calls
    }
  }

  void find_others() {
    StoreReport report;
    for (std::size_t k = 0; k < results_.size(); ++k) {
      if (schedule_.own(k)) {
        if (!cases_.find_kept(k, true))
          refuse_bad_file("the result of " + cases_.name(k) + " could not be stored",
                          "check permission and space of the folder of --store");
        if (!results_[k]->failure.empty()) report.failed.emplace_back(k, results_[k]->failure);
        continue;
      }
      if (!schedule_.needs_others) continue;
      if (Finished found = cases_.find_kept(k, true)) {
        const std::lock_guard lock(mutex_);
        finish(k, std::move(found));
      } else {
        report.missing.push_back(k);
      }
    }
    schedule_.report(report);
    show();
  }

  // True if all is done.
  bool look() {
    bool over = false, open = false;
    {
      std::unique_lock lock(mutex_);
      over = changed_.wait_for(lock, ranks_ != nullptr ? exchange_every : look_every,
                               [this] { return working_ == 0 || !outbox_.empty(); });
      over = working_ == 0;
      open = open_;
    }
    if (leads()) lead();
    if (follows() && open) follow();
    if (stop_flag().reason() != StopReason::none) cases_.interrupt();
    const auto [done, failed] = show();
    if (!over) {
      const std::string part = std::to_string(done) + " of " + std::to_string(wanted_) + " cases done" +
                               (failed > 0 ? ", " + std::to_string(failed) + " failed" : "");
      const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begun_;
      schedule_.monitor.progress_of_parts(
          "ensemble", static_cast<double>(done) / static_cast<double>(wanted_), part, since.count());
    }
    return over;
  }

  std::pair<std::size_t, std::size_t> show() {
    std::string output;
    std::vector<std::string> warnings, failures;
    std::size_t done = 0, failed = 0;
    {
      const std::lock_guard lock(mutex_);
      done = done_;
      failed = failed_;
      for (; shown_ < finished_.size() && finished_[shown_]; ++shown_) {
        FinishedCase& result = *results_[shown_];
        output += result.output;
        result.output.clear();
        warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
        if (!result.failure.empty())
          failures.push_back(cases_.name(shown_) + " failed: " + without_traceback(result.failure));
      }
    }
    if (!output.empty()) schedule_.print(output);
    for (const std::string& warning : warnings)
      if (warned_.insert(warning).second) schedule_.monitor.warn(warning);
    for (const std::string& failure : failures) schedule_.monitor.warn(failure);
    return {done, failed};
  }

  EnsembleCases& cases_;
  const CaseSchedule& schedule_;
  Ranks* const ranks_;
  std::string name_;                          // in messages
  std::vector<std::set<std::size_t>> given_;  // rank 0: unfinished cases by rank
  std::vector<std::size_t> idle_;             // rank 0: idle threads by rank
  std::size_t wanted_ = 0;

  std::mutex mutex_;  // guards the members up to working_
  std::condition_variable changed_, more_;
  bool open_ = false;                                     // more may come
  std::vector<std::pair<std::size_t, Finished>> outbox_;  // other ranks: finished cases
  std::deque<std::size_t> waiting_;                       // not yet begun
  std::vector<Finished> results_;
  std::vector<bool> finished_;
  std::size_t done_ = 0, failed_ = 0;
  std::size_t working_ = 0;

  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::size_t shown_ = 0;
  std::set<std::string> warned_;
};

}  // namespace

std::vector<Finished> run_cases(EnsembleCases& cases, const CaseSchedule& schedule) {
  if (cases.count() == 0) return {};
  return CaseScheduler(cases, schedule).run();
}

}  // namespace asperity
