// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/case_roster.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>
#include <utility>

#include "bindings/lua/ensemble/stored_cases.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/text.hpp"
#include "engine/run/result_files.hpp"

namespace asperity::lua {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view rosters_folder = "ensembles";
constexpr std::size_t most_listed = 100'000;

const Json& roster_member(const Json& json, std::string_view name) {
  if (const Json* found = json.find(name)) return *found;
  refuse_bad_file("a list of cases has no `" + std::string(name) + "`");
}

CaseRoster roster_from(const Json& json) {
  CaseRoster roster;
  roster.script = roster_member(json, "script").string();
  roster.place = roster_member(json, "place").string();
  roster.build = roster_member(json, "build").string();
  roster.ensemble = static_cast<int>(roster_member(json, "ensemble").number());
  roster.shards = static_cast<int>(roster_member(json, "shards").number());
  for (const Json& entry : roster_member(json, "cases").list()) {
    RosterEntry one{roster_member(entry, "name").string(), {}};
    for (const Json& key : roster_member(entry, "keys").list()) one.keys.push_back(key.string());
    roster.cases.push_back(std::move(one));
  }
  return roster;
}

}  // namespace

void note_roster(const fs::path& store, const std::string& script_digest, CaseRoster roster,
                 std::size_t cases, const std::function<RosterEntry(std::size_t)>& entry,
                 const std::function<bool(std::int64_t bytes)>& fits) {
  const std::string name = Digester()
                               .add(script_digest)
                               .add(roster.build)
                               .add(std::int64_t{roster.ensemble})
                               .add(static_cast<std::int64_t>(cases))
                               .hex();
  const fs::path file = store / rosters_folder / (name + ".json");
  std::error_code problem;
  if (cases > most_listed || fs::exists(file, problem)) return;
  Json::List list;
  for (std::size_t k = 0; k < cases; ++k) {
    const RosterEntry one = entry(k);
    list.push_back(Json::object({{"name", one.name}, {"keys", Json::strings(one.keys)}}));
  }
  const std::string text = Json::object({{"script", roster.script},
                                         {"place", roster.place},
                                         {"build", roster.build},
                                         {"ensemble", roster.ensemble},
                                         {"shards", roster.shards},
                                         {"cases", std::move(list)}})
                               .text();
  if (!fits(static_cast<std::int64_t>(text.size()) + 1)) return;
  try {
    fs::create_directories(file.parent_path(), problem);
    write_atomically(file, text + "\n");
  } catch (const Error&) {
  }
}

std::vector<CaseRoster> rosters_in(const fs::path& store) {
  std::vector<CaseRoster> rosters;
  std::error_code problem;
  for (fs::directory_iterator entry(store / rosters_folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    std::error_code gone;
    if (entry->path().extension() != ".json" || is_part(entry->path()) || !entry->is_regular_file(gone))
      continue;
    std::ostringstream text;
    text << std::ifstream(entry->path(), std::ios::binary).rdbuf();
    try {
      rosters.push_back(roster_from(Json::parse(text.str(), quoted(entry->path().string()))));
    } catch (const Error&) {
    }
  }
  std::ranges::sort(rosters, {}, [](const CaseRoster& roster) {
    return std::tuple(roster.script, roster.ensemble, roster.build, roster.cases.size());
  });
  return rosters;
}

StoreReport look_up(const fs::path& store, const CaseRoster& roster) {
  ResultFiles results({.folder = store, .also = {}, .build = roster.build, .needed = {}});
  StoreReport report;
  for (std::size_t k = 0; k < roster.cases.size(); ++k) {
    const std::vector<std::string>& keys = roster.cases[k].keys;
    if (std::ranges::any_of(keys, [&](const std::string& key) { return results.find(key).has_value(); }))
      continue;
    std::optional<std::string> failure;
    for (const std::string& key : keys)
      if (const std::optional<FoundResult> found = results.find(std::string(failed_case) + key);
          found && !failure)
        failure = found->text("failure");
    if (failure)
      report.failed.emplace_back(k, *failure);
    else
      report.missing.push_back(k);
  }
  return report;
}

std::string cases_text(const std::vector<std::size_t>& cases, std::size_t count, int shards) {
  std::vector<std::string> parts;
  const auto text = [&](const std::string& noun) {
    constexpr std::size_t most = 20;
    if (parts.size() > most) {
      const std::string more = std::to_string(parts.size() - most) + " more";
      parts.resize(most);
      parts.push_back(more);
    }
    return noun + joined(parts, " and ");
  };
  std::vector<std::size_t> among(static_cast<std::size_t>(shards));
  for (const std::size_t k : cases)
    if (shards > 0) ++among[k % among.size()];
  std::size_t covered = 0;
  for (std::size_t s = 0; s < among.size(); ++s) {
    if (among[s] == 0 || among[s] != count / among.size() + (s < count % among.size() ? 1 : 0)) continue;
    parts.push_back(Shard{static_cast<int>(s) + 1, shards}.text());
    covered += among[s];
  }
  if (covered == cases.size() && !parts.empty()) return text(parts.size() == 1 ? "shard " : "shards ");
  parts.clear();
  for (std::size_t k = 0, last = 0; k < cases.size(); k = last + 1) {
    for (last = k; last + 1 < cases.size() && cases[last + 1] == cases[last] + 1;) ++last;
    parts.push_back(std::to_string(cases[k] + 1) +
                    (last > k ? " to " + std::to_string(cases[last] + 1) : std::string()));
  }
  return text(cases.size() == 1 ? "case " : "cases ");
}

}  // namespace asperity::lua
