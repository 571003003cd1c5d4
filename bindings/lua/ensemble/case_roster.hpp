// SPDX-License-Identifier: GPL-3.0-or-later
// The list of an ensemble's cases in the folder of a shared store: their names, and the keys of their
// results. With it `asperity status` finds out which cases are stored without running the script, and a merge
// finds cases that another build has stored. One JSON file for an ensemble of a script and a build, written
// by the first process that comes to the ensemble. It lists at most 100 000 cases.
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
  std::vector<std::string> keys;  // the result is stored under one of them
};

struct CaseRoster {
  std::string script, place;  // "study.lua", "at study.lua:12"
  std::string build;          // of the program; results of another build are not taken
  int ensemble = 1;           // of the script, counted from 1
  int shards = 0;             // into which the process that wrote it divides the cases; 0: none
  std::vector<RosterEntry> cases;
};

// Writes the list unless it is there. A list that cannot be written or does not fit is left out: no result
// depends on it.
void note_roster(const std::filesystem::path& store, const std::string& script_digest, CaseRoster roster,
                 std::size_t cases, const std::function<RosterEntry(std::size_t)>& entry,
                 const std::function<bool(std::int64_t bytes)>& fits);

// The lists of a store, by script and ensemble. Damaged ones are left out.
std::vector<CaseRoster> rosters_in(const std::filesystem::path& store);

// Missing and failed cases of a list.
StoreReport look_up(const std::filesystem::path& store, const CaseRoster& roster);

// "cases 2, 3 and 5 to 9", of `count`; "shards 2/3 and 3/3" where they are exactly those of whole shards.
std::string cases_text(const std::vector<std::size_t>& cases, std::size_t count, int shards);

}  // namespace asperity::lua
