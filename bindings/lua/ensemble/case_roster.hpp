// SPDX-License-Identifier: GPL-3.0-or-later
// The list of an ensemble's cases in a shared store: names and result keys. `asperity status` finds stored
// cases without the script, and a merge finds cases of other builds. One JSON file for each ensemble, script
// and build, written by the first process; at most 100,000 cases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/case_scheduler.hpp"

namespace asperity::lua {

struct RosterEntry {
  std::string name;               // "case D = 2.5, seed = 3"
  std::vector<std::string> keys;  // possible result keys
};

struct CaseRoster {
  std::string script, place;  // "study.lua", "at study.lua:12"
  std::string build;          // shares no results with others
  int ensemble = 1;           // in the script, from 1
  int shards = 0;             // 0: none
  std::vector<RosterEntry> cases;
};

// Skips an existing, unwritable or too large list: no result depends on it.
void note_roster(const std::filesystem::path& store, const std::string& script_digest, CaseRoster roster,
                 std::size_t cases, const std::function<RosterEntry(std::size_t)>& entry,
                 const std::function<bool(std::int64_t bytes)>& fits);

// By script and ensemble, without damaged lists.
std::vector<CaseRoster> rosters_in(const std::filesystem::path& store);

StoreReport look_up(const std::filesystem::path& store, const CaseRoster& roster);

// "cases 2, 3 and 5 to 9"; "shards 2/3 and 3/3" for whole shards.
std::string cases_text(const std::vector<std::size_t>& cases, std::size_t count, int shards);

}  // namespace asperity::lua
