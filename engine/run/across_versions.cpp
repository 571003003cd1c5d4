// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/across_versions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "engine/run/journal.hpp"

namespace asperity {

namespace {

constexpr double rounding_of_column = 1e-12;

// The rows of one notebook, or the verdicts of its expectations, in the order of the journal.
struct Results {
  std::string name;                          // "events, row"
  std::vector<const Json*> entries{};        // objects
  std::map<std::string, double> greatest{};  // of each column with numbers
};

std::vector<Results> results_in(const std::vector<Json>& journal) {
  std::vector<Results> all;
  for (const Json& line : journal) {
    const Json *row = line.find("row"), *notebook = line.find("notebook");
    const bool is_verdict = row == nullptr && line.find("passed") != nullptr;
    if (notebook == nullptr || !notebook->is_string() ||
        !(is_verdict || (row != nullptr && row->is_object())))
      continue;
    const std::string name = notebook->string() + (is_verdict ? ", expectation" : ", row");
    auto place = std::find_if(all.begin(), all.end(), [&](const Results& r) { return r.name == name; });
    if (place == all.end()) place = all.insert(all.end(), Results{name});
    place->entries.push_back(is_verdict ? &line : row);
    if (is_verdict) continue;
    for (const auto& [column, value] : row->members())
      if (value.is_number())
        place->greatest[column] = std::max(place->greatest[column], std::abs(value.number()));
  }
  return all;
}

bool agree(const Json& one, const Json& other, double greatest) {
  if (!one.is_number() || !other.is_number()) return one == other;
  const double a = one.number(), b = other.number();
  return a == b || std::abs(a - b) <= std::max(digits_kept * std::max(std::abs(a), std::abs(b)),
                                               rounding_of_column * greatest);
}

}  // namespace

bool same_minor_version(std::string_view one, std::string_view other) {
  const auto minor = [](std::string_view version) { return version.substr(0, version.rfind('.')); };
  return one == other || (std::count(one.begin(), one.end(), '.') == 2 && minor(one) == minor(other));
}

AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again) {
  AcrossVersions result;
  const std::vector<Results> now = results_in(again.journal);
  for (const Results& then : results_in(recorded.journal)) {
    const auto place =
        std::find_if(now.begin(), now.end(), [&](const Results& r) { return r.name == then.name; });
    const std::size_t count = then.entries.size(),
                      again_count = place != now.end() ? place->entries.size() : 0;
    const bool verdicts = then.name.ends_with(", expectation");
    for (std::size_t k = 0; k < std::min(count, again_count); ++k)
      for (const auto& [column, value] : then.entries[k]->members()) {
        if (verdicts && column != "passed") continue;
        const Json* other = place->entries[k]->find(column);
        const auto greatest = then.greatest.find(column);
        ++result.compared;
        if (other == nullptr || !agree(value, *other, greatest != then.greatest.end() ? greatest->second : 0))
          result.differences.push_back(
              {then.name + " " + std::to_string(k + 1) + ", " + column, brief(&value), brief(other)});
      }
    if (again_count < count || (recorded.ended() && again_count > count))
      result.differences.push_back({then.name + "s", std::to_string(count), std::to_string(again_count)});
  }
  return result;
}

}  // namespace asperity
