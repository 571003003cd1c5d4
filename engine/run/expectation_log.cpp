// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/expectation_log.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

Json to_json(const Verdict& verdict) {
  Json json;
  json.set("notebook", verdict.notebook).set("passed", verdict.passed);
  if (!verdict.judged) json.set("judged", false);
  if (verdict.should_fail) json.set("should_fail", true);
  if (!verdict.label.empty()) json.set("label", verdict.label);
  json.set("sentence", verdict.sentence);
  return json;
}

void ExpectationLog::add(Verdict verdict) {
  const std::lock_guard lock(mutex_);
  verdicts_.push_back(std::move(verdict));
}

std::vector<Verdict> ExpectationLog::exchange(std::vector<Verdict> verdicts) {
  const std::lock_guard lock(mutex_);
  return std::exchange(verdicts_, std::move(verdicts));
}

std::vector<Verdict> ExpectationLog::verdicts() const {
  const std::lock_guard lock(mutex_);
  return verdicts_;
}

std::size_t ExpectationLog::failed() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::ranges::count(verdicts_, false, &Verdict::passed));
}

std::string ExpectationLog::summary() const {
  const std::vector<Verdict> all = verdicts();
  if (all.empty()) return {};
  const auto held = static_cast<std::size_t>(std::ranges::count(all, true, &Verdict::passed));
  const auto controls = static_cast<std::size_t>(
      std::ranges::count_if(all, [](const Verdict& v) { return v.passed && v.should_fail; }));
  const bool one = all.size() == 1;
  std::string text;
  if (held == all.size()) {
    text = one ? "1 expectation holds" : std::to_string(all.size()) + " expectations hold";
  } else {
    text = std::to_string(all.size() - held) + " of " + std::to_string(all.size()) +
           (one ? " expectation" : " expectations") + (all.size() - held == 1 ? " fails" : " fail");
  }
  if (controls == 1) text += " (1 negative control fails, as it should)";
  if (controls > 1) text += " (" + std::to_string(controls) + " negative controls fail, as they should)";
  return text;
}

}  // namespace asperity
