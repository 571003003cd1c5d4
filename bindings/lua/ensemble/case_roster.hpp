// SPDX-License-Identifier: GPL-3.0-or-later
// The list of an ensemble's cases in a shared store: case names and result keys. `asperity status` uses the
// list to find stored cases without the script, and a merge to find cases stored by other builds. One JSON
// file for each ensemble of a script and a build, written by the first process; at most 100,000 cases.
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
  std::vector<std::string> keys;  // possible keys of the result
};

struct CaseRoster {
  std::string script, place;  // "study.lua", "at study.lua:12"
  std::string build;          // of the program; builds do not share results
  int ensemble = 1;           // number in the script, from 1
  int shards = 0;             // of the writing process; 0: none
  std::vector<RosterEntry> cases;
};

// Writes the list unless it exists. Skips a list that cannot be written or does not fit: no result depends on
// it.
void note_roster(const std::filesystem::path& store, const std::string& script_digest, CaseRoster roster,
                 std::size_t cases, const std::function<RosterEntry(std::size_t)>& entry,
                 const std::function<bool(std::int64_t bytes)>& fits);

// Sorted by script and ensemble; damaged lists are skipped.
std::vector<CaseRoster> rosters_in(const std::filesystem::path& store);

StoreReport look_up(const std::filesystem::path& store, const CaseRoster& roster);

// "cases 2, 3 and 5 to 9", of `count`; "shards 2/3 and 3/3" for whole shards.
std::string cases_text(const std::vector<std::size_t>& cases, std::size_t count, int shards);

}  // namespace asperity::lua
