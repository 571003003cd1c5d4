// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/crew.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity::lua {

namespace {

constexpr auto look_every = std::chrono::milliseconds(20);

class Crew {
 public:
  Crew(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup, Session& session)
      : setup_(setup), session_(session), results_(cases), finished_(cases, false) {}

  std::vector<CaseResult> run() {
    const int threads = thread_count();
    const std::size_t wanted = std::min(results_.size(), static_cast<std::size_t>(threads));
    // A case that works alone may use all threads, unless it is itself inside a case.
    const bool single = wanted > 1 || threads == 1;
    {
      std::vector<std::jthread> workers;
      const Ending ending(*this);
      start(workers, wanted, single);
      while (!look()) {
      }
    }
    stop_flag().check();
    double transforms = 0;
    for (const CaseResult& result : results_) transforms += result.transforms;
    cost::count_transforms(transforms);
    return std::move(results_);
  }

 private:
  // No case is begun after this, whatever the way out; then the threads are joined.
  struct Ending {
    explicit Ending(Crew& c) : crew(c) {}
    ~Ending() { crew.next_.store(crew.results_.size()); }
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;
    Crew& crew;
  };

  void start(std::vector<std::jthread>& workers, std::size_t wanted, bool single) {
    for (std::size_t k = 0; k < wanted; ++k) {
      {
        const std::lock_guard lock(mutex_);
        ++working_;
      }
      try {
        workers.emplace_back([this, single] { work(single); });
      } catch (const std::system_error&) {
        const std::lock_guard lock(mutex_);
        --working_;
        if (workers.empty()) throw Error(ErrorCode::out_of_memory, "no thread could be started");
        return;
      }
    }
  }

  void work(bool single) {
    std::optional<SingleThreaded> alone;
    if (single) alone.emplace();
    while (stop_flag().reason() == StopReason::none) {
      const std::size_t k = next_.fetch_add(1);
      if (k >= results_.size()) break;
      CaseResult result;
      try {
        result = run_case(setup_(k), states_);
      } catch (const std::exception& error) {
        result.failure = error.what();
      }
      const std::lock_guard lock(mutex_);
      if (!result.failure.empty()) ++failed_;
      results_[k] = std::move(result);
      finished_[k] = true;
      ++done_;
    }
    const std::lock_guard lock(mutex_);
    if (--working_ == 0) changed_.notify_all();
  }

  // Waits a little, then shows what is new. True when all is done.
  bool look() {
    std::string output;
    std::vector<std::string> warnings, failures;
    std::size_t done = 0, failed = 0;
    bool over = false;
    {
      std::unique_lock lock(mutex_);
      over = changed_.wait_for(lock, look_every, [this] { return working_ == 0; });
      done = done_;
      failed = failed_;
      for (; shown_ < finished_.size() && finished_[shown_]; ++shown_) {
        CaseResult& result = results_[shown_];
        output += result.output;
        result.output.clear();
        warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
        // A stop makes the states that run fail: that is no failure of their cases.
        if (!result.failure.empty() && stop_flag().reason() == StopReason::none)
          failures.push_back(case_name(setup_(shown_).values) +
                             " failed: " + without_traceback(result.failure));
      }
    }
    if (stop_flag().reason() != StopReason::none) states_.interrupt();
    std::fwrite(output.data(), 1, output.size(), session_.output);
    for (const std::string& warning : warnings)
      if (warned_.insert(warning).second) session_.monitor().warn(warning);
    for (const std::string& failure : failures) session_.monitor().warn(failure);
    if (!over) {
      const std::string part = std::to_string(done) + " of " + std::to_string(results_.size()) +
                               " cases done" + (failed > 0 ? ", " + std::to_string(failed) + " failed" : "");
      const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begun_;
      session_.monitor().progress_of_parts(
          "ensemble", static_cast<double>(done) / static_cast<double>(results_.size()), part, since.count());
    }
    return over;
  }

  const std::function<CaseSetup(std::size_t)>& setup_;
  Session& session_;
  RunningStates states_;
  std::atomic<std::size_t> next_{0};

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::vector<CaseResult> results_;
  std::vector<bool> finished_;
  std::size_t done_ = 0, failed_ = 0;
  std::size_t working_ = 0;

  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::size_t shown_ = 0;
  std::set<std::string> warned_;
};

}  // namespace

std::vector<CaseResult> run_cases(std::size_t cases, const std::function<CaseSetup(std::size_t)>& setup,
                                  Session& session) {
  if (cases == 0) return {};
  return Crew(cases, setup, session).run();
}

}  // namespace asperity::lua
