// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity status STORE`: stored and missing cases, from rosters in the store
// (lua/ensemble/case_roster.hpp).
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/commands/command.hpp"
#include "bindings/lua/ensemble/case_roster.hpp"
#include "engine/core/error.hpp"
#include "engine/core/program_identity.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

namespace {

// Exit status: 0 complete; 1 a case failed; 3 cases missing. Rosters of other builds count only without one
// of this build.
int show_status(const std::string& store) {
  std::error_code problem;
  if (!std::filesystem::is_directory(store, problem)) {
    std::fprintf(stderr, "asperity: there is no folder %s; give the one of --store\n", quoted(store).c_str());
    return bad_usage;
  }
  const std::vector<lua::CaseRoster> rosters = lua::rosters_in(store);
  if (rosters.empty()) {
    std::printf("%s: no run with --store has come to an ensemble yet\n", store.c_str());
    return cases_missing;
  }
  const std::string own = build_identity();
  const bool any_own = std::ranges::any_of(rosters, [&](const auto& roster) { return roster.build == own; });
  int status = done;
  for (const lua::CaseRoster& roster : rosters) {
    const StoreReport report = lua::look_up(store, roster);
    const std::size_t count = roster.cases.size();
    std::printf("%s, ensemble %d, %s: %zu of %zu cases are stored, %zu failed, %zu are missing\n",
                roster.script.c_str(), roster.ensemble, roster.place.c_str(),
                count - report.missing.size() - report.failed.size(), count, report.failed.size(),
                report.missing.size());
    std::printf("  build    %s%s\n", roster.build.c_str(),
                roster.build == own ? "" : ", another one; this build does not use its results");
    for (const auto& [k, why] : report.failed)
      std::printf("  failed   %zu\t%s: %s\n", k + 1, roster.cases[k].name.c_str(), why.c_str());
    if (!report.missing.empty())
      std::printf("  missing  %s\n", lua::cases_text(report.missing, count, roster.shards).c_str());
    if (any_own && roster.build != own) continue;
    if (!report.missing.empty())
      status = cases_missing;
    else if (!report.failed.empty() && status == done)
      status = failed;
  }
  return status;
}

}  // namespace

Command status_command() {
  return {
      .name = "status",
      .sentence =
          "which cases in the folder given by --store are stored, failed or missing, and by which "
          "build; exit status 3 where cases are missing, else 1 where cases failed",
      .overview = "asperity status STORE                          which cases are stored, failed, missing\n",
      .declare = [](CLI::App& options) -> CommandReader {
        const auto store = std::make_shared<std::string>();
        options.add_option("store", *store, "the folder")->required();
        return [store]() -> CommandWork { return [store] { return show_status(*store); }; };
      }};
}

}  // namespace asperity::cli
