// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/ledger.hpp"

#include <algorithm>
#include <functional>
#include <new>

#include "engine/contact/scene/known_effects.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

thread_local LedgerScope* innermost = nullptr;

Json to_json(const Cost& cost) {
  return Json::object({{"seconds", cost.seconds}, {"transforms", cost.transforms}, {"bytes", cost.bytes}});
}

std::string seconds_text(double seconds) { return format_quantity(seconds, dimension::time, 3); }

std::vector<std::string> cells(std::string name, std::int64_t calls, const Cost& cost) {
  return {std::move(name), calls == 0 ? "" : std::to_string(calls), seconds_text(cost.seconds),
          cost.transforms == 0 ? "" : format_short(cost.transforms, 4),
          cost.bytes == 0 ? "" : format_bytes(cost.bytes)};
}

}  // namespace

double LedgerReport::unaccounted() const {
  double left = seconds;
  for (const LedgerLine& line : lines)
    if (!line.in_case) left -= line.cost.seconds;
  return std::max(left, 0.0);
}

std::string LedgerReport::text() const {
  std::vector<std::vector<std::string>> rows = {{"call", "times", "time", "transforms", "memory"}};
  for (const LedgerLine& line : lines)
    if (!line.in_case) rows.push_back(cells(line.call, line.calls, line.cost));
  rows.push_back(cells("the script, and all else", 0, {unaccounted(), 0, 0}));
  rows.push_back(cells("together", 0, {seconds, transforms, bytes}));
  if (std::ranges::any_of(lines, [](const LedgerLine& line) { return line.in_case; })) {
    rows.push_back({"inside cases, all threads together"});
    for (const LedgerLine& line : lines)
      if (line.in_case) rows.push_back(cells("  " + line.call, line.calls, line.cost));
  }
  if (!by_effect.empty()) {
    rows.push_back({"contacts, by effect"});
    for (const auto& [effect, cost] : by_effect) rows.push_back(cells("  " + effect, 0, cost));
  }
  std::string result = "ledger" + aligned(rows, true) + "\n";
  if (!by_effect.empty() && !effects_off.empty())
    result += "  off, and nothing done for them: " + joined(effects_off, ", ") + "\n";
  return result;
}

Json LedgerReport::json() const {
  Json::List calls;
  for (const LedgerLine& line : lines)
    calls.push_back(Json::object({{"call", line.call},
                                  {"in_case", line.in_case},
                                  {"times", line.calls},
                                  {"cost", to_json(line.cost)}}));
  Json effects = Json::object();
  for (const auto& [effect, cost] : by_effect) effects.set(effect, to_json(cost));
  return Json::object({{"seconds", seconds},
                       {"transforms", transforms},
                       {"bytes", bytes},
                       {"unaccounted_seconds", unaccounted()},
                       {"calls", calls},
                       {"by_effect", effects},
                       {"effects_off", Json::strings(effects_off)}});
}

void Ledger::add(std::string_view call, bool in_case, const Cost& own) {
  const std::scoped_lock lock(mutex_);
  auto line = std::ranges::find_if(
      lines_, [&](const LedgerLine& known) { return known.call == call && known.in_case == in_case; });
  if (line == lines_.end()) line = lines_.insert(lines_.end(), {std::string(call), in_case, 0, {}});
  ++line->calls;
  line->cost += own;
}

void Ledger::add_effects(std::span<const std::pair<std::string, Cost>> by_effect) {
  const std::scoped_lock lock(mutex_);
  for (const auto& added : by_effect) {
    auto known =
        std::ranges::find_if(by_effect_, [&](const auto& entry) { return entry.first == added.first; });
    if (known == by_effect_.end()) known = by_effect_.insert(by_effect_.end(), {added.first, {}});
    known->second += added.second;
  }
}

LedgerReport Ledger::report() const {
  LedgerReport report;
  {
    const std::scoped_lock lock(mutex_);
    report.lines = lines_;
    report.by_effect = by_effect_;
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  for (const LedgerLine& line : report.lines) {
    report.transforms += line.cost.transforms;
    report.bytes = std::max(report.bytes, line.cost.bytes);
  }
  const auto dearest_first = [](auto& entries, auto seconds) {
    std::ranges::stable_sort(entries, std::greater(), seconds);
  };
  dearest_first(report.lines, [](const LedgerLine& line) { return line.cost.seconds; });
  std::stable_partition(report.lines.begin(), report.lines.end(),
                        [](const LedgerLine& line) { return !line.in_case; });
  dearest_first(report.by_effect, [](const auto& entry) { return entry.second.seconds; });
  std::vector<std::string> run;
  for (const auto& [effect, cost] : report.by_effect) run.push_back(effect);
  report.effects_off = effects_not_in(run);
  return report;
}

LedgerScope::LedgerScope(Ledger& ledger, std::string_view owner, std::string_view call, bool in_case,
                         bool lasting)
    : ledger_(ledger), owner_(owner), call_(call), in_case_(in_case), lasting_(lasting), outer_(innermost) {
  innermost = this;
}

LedgerScope::~LedgerScope() {
  innermost = outer_;
  const Cost all = cost_.so_far();
  if (forgotten_ || (!lasting_ && all.seconds < shortest)) return;
  Cost own = all;
  own.seconds = std::max(own.seconds - inner_.seconds, 0.0);
  own.transforms = std::max(own.transforms - inner_.transforms, 0.0);
  try {
    ledger_.add(owner_.empty() ? std::string(call_) : std::string(owner_) + "." + std::string(call_),
                in_case_, own);
  } catch (const std::bad_alloc&) {
    return;  // counts as the script's time
  }
  if (outer_ == nullptr) return;
  outer_->inner_.transforms += all.transforms;
  // An ensemble costs its waiting time for cases, on any thread.
  if (outer_->in_case_ == in_case_) outer_->inner_.seconds += all.seconds;
}

}  // namespace asperity
