// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/explanation.hpp"

#include <algorithm>

#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/run/plan_json.hpp"

namespace asperity::lua {

void Explanation::note(const Plan& plan, const std::string& what, std::int64_t solves) {
  const std::string text = plan.text();
  auto same =
      std::find_if(planned_.begin(), planned_.end(), [&](const Planned& p) { return p.plan.text() == text; });
  if (same == planned_.end()) same = planned_.insert(planned_.end(), {plan, {}});
  auto known = std::find_if(same->calls.begin(), same->calls.end(),
                            [&](const auto& call) { return call.first == what; });
  if (known == same->calls.end()) known = same->calls.insert(same->calls.end(), {what, 0});
  known->second += times_ * solves;
}

Explanation::Repeating::Repeating(Explanation* explanation, std::int64_t times) : explanation_(explanation) {
  if (explanation_ == nullptr) return;
  outer_ = explanation_->times_;
  explanation_->times_ *= std::max<std::int64_t>(times, 1);
}

Explanation::Repeating::~Repeating() {
  if (explanation_ != nullptr) explanation_->times_ = outer_;
}

std::int64_t Explanation::Planned::solves() const {
  std::int64_t sum = 0;
  for (const auto& call : calls) sum += call.second;
  return sum;
}

std::string Explanation::text() const {
  std::string unplanned;
  for (const auto& [what, count] : unplanned_)
    unplanned += what + ": " + std::to_string(count) + (count == 1 ? " time" : " times") +
                 ", of a contact that is not known before the run or lies over ranks: no plan\n";
  if (planned_.empty()) return unplanned.empty() ? "no contact is pressed\n" : unplanned;
  std::string result;
  double transforms = 0, seconds = 0;
  std::int64_t bytes = 0, solves = 0;
  for (const Planned& planned : planned_) {
    result += planned.plan.text();
    for (const auto& [what, times] : planned.calls)
      result += "  " + what + ": " + std::to_string(times) + (times == 1 ? " time\n" : " times\n");
    result += "\n";
    const auto count = static_cast<double>(planned.solves());
    transforms += count * planned.plan.transforms;
    seconds += count * planned.plan.seconds;
    bytes = std::max(bytes, planned.plan.bytes_peak());
    solves += planned.solves();
  }
  return result + unplanned + "together: " + std::to_string(solves) + (solves == 1 ? " press" : " presses") +
         ", about " + format_short(transforms, 3) + " transforms and " +
         format_quantity(seconds, dimension::time, 3) + ", " + format_bytes(bytes) +
         " at most in one contact\n";
}

Json Explanation::json() const {
  Json::List contacts;
  for (const Planned& planned : planned_) {
    Json calls = Json::object();
    for (const auto& [what, times] : planned.calls) calls.set(what, times);
    contacts.push_back(Json::object({{"plan", to_json(planned.plan)}, {"calls", calls}}));
  }
  Json unplanned = Json::object();
  for (const auto& [what, count] : unplanned_) unplanned.set(what, count);
  return Json::object({{"contacts", contacts}, {"unplanned", unplanned}});
}

}  // namespace asperity::lua
