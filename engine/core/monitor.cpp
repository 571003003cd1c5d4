// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/monitor.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

namespace {
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}  // namespace

void StopFlag::check() const {
  constexpr std::pair<ErrorCode, const char*> stops[] = {
      {ErrorCode::interrupted, "interrupted"},
      {ErrorCode::time_limit, "the time limit of the run is reached"},
      {ErrorCode::out_of_memory, "the memory limit of the run is reached"}};
  if (const StopReason why = reason(); why != StopReason::none) {
    const auto& [code, sentence] = stops[static_cast<int>(why) - 1];
    throw Error(code, sentence);
  }
}

StopFlag& stop_flag() {
  static StopFlag flag;
  return flag;
}

Monitor& Monitor::silent() {
  static Monitor monitor;
  return monitor;
}

std::string kind_of_warning(std::string_view sentence) {
  std::string kind;
  bool quoted = false;
  for (std::size_t k = 0; k < sentence.size(); ++k) {
    const char c = sentence[k];
    if (c == '"' || c == '`') quoted = !quoted;
    // A digit after "=" belongs to a name: `case load = 2000`.
    const bool named = k > 1 && sentence[k - 2] == '=';
    const bool begins = k == 0 || std::string_view(" (-").find(sentence[k - 1]) != std::string_view::npos;
    const bool number = !quoted && begins && !named && c >= '0' && c <= '9';
    kind += number ? '#' : c;
    if (!number) continue;
    std::size_t end = std::min(sentence.find_first_not_of("0123456789.e+-", k), sentence.size());
    // A unit is a short word.
    const std::size_t blank = std::min(sentence.find(' ', end + 1), sentence.size());
    if (end < sentence.size() && sentence[end] == ' ' && blank - end <= 5) end = blank;
    k = end - 1;
  }
  return kind;
}

bool WarningKinds::is_first(std::string_view sentence) {
  const auto [found, first] = kinds_.try_emplace(kind_of_warning(sentence), Kind{std::string(sentence)});
  if (!first) ++found->second.more;
  return first;
}

std::vector<std::string> WarningKinds::rest() {
  std::vector<std::string> lines;
  for (auto& [kind, of] : kinds_) {
    if (of.more > 0)
      lines.push_back(std::to_string(of.more) + " more like this one, with other numbers: " + of.first);
    of.more = 0;
  }
  return lines;
}

Task::Task(Monitor& monitor, std::string_view what, std::int64_t total)
    : monitor_(monitor), what_(what), total_(std::max<std::int64_t>(total, 1)), last_report_(now()) {
  stop_flag().check();
}

void Task::advance(std::int64_t steps) {
  stop_flag().check();
  done_ += steps;
  if (done_ < next_look_) return;
  next_look_ = done_ + std::max<std::int64_t>(total_ / 1000, 1);
  constexpr double report_every = 0.1;  // seconds
  const double time = now();
  if (time - last_report_ < report_every) return;
  last_report_ = time;
  monitor_.progress(what_, static_cast<double>(std::min(done_, total_)) / static_cast<double>(total_));
}

PartMonitor::PartMonitor(Monitor& outer, std::string whole, std::string part, double before, double after,
                         Clock::time_point begun)
    : outer_(outer),
      whole_(std::move(whole)),
      part_(std::move(part)),
      before_(before),
      after_(after),
      begun_(begun),
      results_(outer.results()) {}

void PartMonitor::progress(std::string_view, double done) {
  furthest_ = std::max(furthest_, std::min(done, 1.0));
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  outer_.progress_of_parts(whole_, before_ + furthest_ * (after_ - before_), part_, seconds);
}

}  // namespace asperity
