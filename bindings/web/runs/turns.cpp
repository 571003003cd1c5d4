// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/turns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::web {

namespace {

double seconds_between(Turns::Clock::time_point from, Turns::Clock::time_point to) {
  return std::max(0.0, std::chrono::duration<double>(to - from).count());
}

double faded(double used, Turns::Clock::time_point from, Turns::Clock::time_point to) {
  constexpr double memory_seconds = 300;
  return used * std::exp(-seconds_between(from, to) / memory_seconds);
}

}  // namespace

std::shared_ptr<void> Turns::take(std::size_t person, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto call = calls_.insert(calls_.end(), person);
  const bool served = changed_.wait_for(lock, patience, [&] { return is_next(call); });
  calls_.erase(call);
  const Clock::time_point begun = Clock::now();
  if (served) begin(person, begun);
  // The next in line may be served, too.
  changed_.notify_all();
  if (!served) return nullptr;
  return {this, [this, person, begun](void*) {
            const std::lock_guard giving_back(mutex_);
            const Clock::time_point now = Clock::now();
            end(person, begun, seconds_between(begun, now), now);
            changed_.notify_all();
          }};
}

std::size_t Turns::waiting() const {
  const std::lock_guard lock(mutex_);
  return calls_.size();
}

// Earlier calls of a person come first.
bool Turns::is_next(std::list<std::size_t>::iterator call) {
  std::vector<std::size_t> persons;
  for (const std::size_t person : calls_)
    if (std::ranges::find(persons, person) == persons.end()) persons.push_back(person);
  return next(persons, Clock::now()) == *call && std::find(calls_.begin(), calls_.end(), *call) == call;
}

const Turns::Person& Turns::of(std::size_t person) const {
  static const Person nobody;
  const auto known = people_.find(person);
  return known == people_.end() ? nobody : known->second;
}

double Turns::used(std::size_t person, Clock::time_point now) const {
  double seconds = faded(of(person).used, of(person).at, now);
  for (const Clock::time_point begun : of(person).uses) seconds += seconds_between(begun, now);
  return seconds;
}

bool Turns::may_begin(std::size_t person, bool others_wait) const {
  std::size_t held = 0, by_slow = 0;
  for (const auto& [known, facts] : people_) {
    held += facts.uses.size();
    if (facts.slow) by_slow += facts.uses.size();
  }
  const int most = rules_.one_while_others_wait && others_wait ? 1 : rules_.each;
  return std::cmp_less(held, rules_.places) && std::cmp_less(of(person).uses.size(), most) &&
         (!of(person).slow || std::cmp_less(by_slow, rules_.places - rules_.for_quick));
}

std::optional<std::size_t> Turns::next(const std::vector<std::size_t>& waiting, Clock::time_point now) const {
  const auto rank = [&](std::size_t person) { return std::pair(used(person, now), of(person).last_turn); };
  std::optional<std::size_t> best;
  for (const std::size_t person : waiting)
    if (may_begin(person, waiting.size() > 1) && (!best || rank(person) < rank(*best))) best = person;
  return best;
}

void Turns::begin(std::size_t person, Clock::time_point now) {
  people_[person].uses.push_back(now);
  people_[person].last_turn = ++turns_;
}

void Turns::end(std::size_t person, Clock::time_point begun, double seconds, Clock::time_point now) {
  Person& known = people_[person];
  if (const auto at = std::ranges::find(known.uses, begun); at != known.uses.end()) known.uses.erase(at);
  known.used = faded(known.used, known.at, now) + seconds;
  known.at = now;
  known.slow = now - begun > rules_.quick;
}

}  // namespace asperity::web
