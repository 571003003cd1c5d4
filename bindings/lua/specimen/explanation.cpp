// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/explanation.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "bindings/lua/specimen/tilt_stage.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {
// Null if unknown.
const SpecimenPair* pressed_by(const Call& call, const Function& function) {
  const auto contact_at = [&](int k) -> const SpecimenPair* {
    const Argument value(call.L, k);
    const auto* stage = value.as<TiltStage>();
    return stage != nullptr ? stage->contact.get() : value.as<SpecimenPair>();
  };
  // Functions with a `path` write files.
  if (!function.heavy ||
      std::ranges::find(function.parameters, "path", &Parameter::name) != function.parameters.end())
    return nullptr;
  const SpecimenPair* own = contact_at(1);
  return own != nullptr || call.count() < 1 ? own : contact_at(2);
}

// One, or the number of values, events or probe pressures.
std::int64_t presses_of(const Call& call) {
  const Argument self(call.L, 1);
  if (const auto* protocol = self.as<Protocol>())
    return std::ranges::count_if(protocol->events(), [](const Protocol::Event& event) {
      return std::holds_alternative<PressRequest>(event.step);
    });
  // Without probe pressures raised during the run.
  if (const auto* stage = self.as<TiltStage>()) {
    const bool probes = !stage->contact->scene().elasticity.model().is_local;
    return probes ? static_cast<std::int64_t>(stage->options.probe_pressures.size()) : 1;
  }
  std::int64_t presses = 1;
  if (call.given(1) && call.argument(1).is_table())
    call.argument(1).each([&](const Argument&, const Argument& loads) {
      if (loads.is_table()) presses = std::max(presses, loads.length());
    });
  return presses;
}

std::vector<Explanation::Asked> known_presses_of(const Call& call, const Function& function) {
  const Argument self(call.L, 1);
  std::vector<Explanation::Asked> asked;
  if (self.as<SpecimenPair>() != nullptr)
    for (PressRequest& request : requests_of(call, function)) asked.push_back({std::move(request)});
  const auto* protocol = self.as<Protocol>();
  if (protocol == nullptr) return asked;
  std::map<std::pair<PressBy, double>, std::size_t> known;
  for (const Protocol::Event& event : protocol->events()) {
    const auto* press = std::get_if<PressRequest>(&event.step);
    if (press == nullptr) continue;
    const auto [at, first] = known.try_emplace({press->by, press->value}, asked.size());
    if (first)
      asked.push_back({*press});
    else
      ++asked[at->second].times;
  }
  return asked;
}

}  // namespace

Explanation::Calls& Explanation::calls_of(Planned& planned, const std::string& what,
                                          std::optional<PressBy> by) {
  auto known = std::find_if(planned.calls.begin(), planned.calls.end(),
                            [&](const Calls& calls) { return calls.what == what && calls.by == by; });
  if (known == planned.calls.end()) known = planned.calls.insert(planned.calls.end(), {what, by, 0, {}});
  return *known;
}

// Plans at most `most_tried` values per control; the mean stands for more.
Explanation::Expected Explanation::expected(const SpecimenPair& pair, const PressRequest& request,
                                            Calls& calls) {
  constexpr std::size_t most_tried = 12;
  const auto known = calls.tried.find(request.value);
  if (known != calls.tried.end()) return known->second;
  if (calls.tried.size() >= most_tried) {
    Expected mean;
    for (const auto& [value, one] : calls.tried) {
      mean.transforms += one.transforms / static_cast<double>(calls.tried.size());
      mean.seconds += one.seconds / static_cast<double>(calls.tried.size());
    }
    return mean;
  }
  Expected found{pair.plan().transforms, pair.plan().seconds};
  try {
    const Plan plan = pair.plan_of(request);
    found = {plan.transforms, plan.seconds};
  } catch (const Error& error) {  // the run reports the error
    if (error.code() != ErrorCode::bad_value && error.code() != ErrorCode::infeasible) throw;
  }
  calls.tried.emplace(request.value, found);
  calls.least = std::min(calls.least, found.transforms);
  calls.most = std::max(calls.most, found.transforms);
  return found;
}

void Explanation::note(const SpecimenPair& pair, const std::string& what, std::span<const Asked> named,
                       std::int64_t presses) {
  std::string text = pair.plan().text();
  auto same =
      std::find_if(planned_.begin(), planned_.end(), [&](const Planned& p) { return p.text == text; });
  if (same == planned_.end()) same = planned_.insert(planned_.end(), {pair.plan(), std::move(text)});
  const auto add = [&](Calls& calls, const Expected& each, std::int64_t times) {
    calls.times += times;
    calls.all.transforms += static_cast<double>(times) * each.transforms;
    calls.all.seconds += static_cast<double>(times) * each.seconds;
  };
  if (named.empty()) {
    add(calls_of(*same, what, {}), {pair.plan().transforms, pair.plan().seconds}, times_ * presses);
    return;
  }
  for (const Asked& asked : named) {
    Calls& calls = calls_of(*same, what, asked.request.by);
    add(calls, expected(pair, asked.request, calls), times_ * asked.times);
  }
}

Explanation::Repeating::Repeating(Explanation* explanation, std::int64_t times) : explanation_(explanation) {
  if (explanation_ == nullptr) return;
  outer_ = explanation_->times_;
  explanation_->times_ *= std::max<std::int64_t>(times, 1);
}

Explanation::Repeating::~Repeating() {
  if (explanation_ != nullptr) explanation_->times_ = outer_;
}

std::string Explanation::text() const {
  std::string unplanned;
  for (const auto& [what, count] : unplanned_)
    unplanned += what + ": " + counted(static_cast<std::size_t>(count), "time") +
                 ", of a contact that is not known before the run or lies over ranks: no plan\n";
  if (planned_.empty()) return unplanned.empty() ? "no contact is pressed\n" : unplanned;
  std::string result;
  double transforms = 0, seconds = 0;
  std::int64_t bytes = 0, solves = 0;
  for (const Planned& planned : planned_) {
    result += planned.text;
    for (const Calls& calls : planned.calls) {
      solves += calls.times;
      result += "  " + calls.what + ": " + counted(static_cast<std::size_t>(calls.times), "time");
      const std::string least = format_short(calls.least, 3), most = format_short(calls.most, 3);
      if (calls.by && calls.most > 0)
        result += " by " + quoted(name(*calls.by)) + ", " + (least == most ? most : least + " to " + most) +
                  " transforms expected of each";
      result += "\n";
    }
    result += "\n";
    Expected expected;  // by plan, in order
    for (const Calls& calls : planned.calls) {
      expected.transforms += calls.all.transforms;
      expected.seconds += calls.all.seconds;
    }
    transforms += expected.transforms;
    seconds += expected.seconds;
    const bool flattens = std::any_of(planned.calls.begin(), planned.calls.end(),
                                      [](const Calls& calls) { return calls.by == PressBy::flatten; });
    bytes = std::max(bytes, planned.plan.bytes_peak() + (flattens ? planned.plan.bytes_to_flatten : 0));
  }
  return result + unplanned + "together: " + std::to_string(solves) + (solves == 1 ? " press" : " presses") +
         ", about " + format_short(transforms, 3) + " transforms and " +
         format_quantity(seconds, dimension::time, 3) + ", " + format_bytes(bytes) +
         " at most in one contact\n";
}

Json Explanation::json() const {
  Json::List contacts;
  for (const Planned& planned : planned_) {
    std::map<std::string, std::int64_t> times;
    Json::List presses;
    for (const Calls& one : planned.calls) {
      times[one.what] += one.times;
      presses.push_back(Json::object({{"call", one.what},
                                      {"by", one.by ? std::string(name(*one.by)) : std::string()},
                                      {"times", one.times},
                                      {"transforms", one.all.transforms},
                                      {"seconds", one.all.seconds}}));
    }
    Json calls = Json::object();
    for (const auto& [what, count] : times) calls.set(what, count);
    contacts.push_back(
        Json::object({{"plan", to_json(planned.plan)}, {"calls", calls}, {"presses", presses}}));
  }
  Json unplanned = Json::object();
  for (const auto& [what, count] : unplanned_) unplanned.set(what, count);
  return Json::object({{"contacts", contacts}, {"unplanned", unplanned}});
}

void note_call(Explanation& explanation, const Call& call, const Function& function) {
  if (const SpecimenPair* pair = pressed_by(call, function))
    explanation.note(*pair, call.function_name(), known_presses_of(call, function), presses_of(call));
  else if (function.returns.find("State") != std::string::npos)
    explanation.note_unplanned(call.function_name());
}

}  // namespace asperity::lua
