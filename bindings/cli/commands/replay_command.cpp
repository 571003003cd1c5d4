// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/replay_command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "bindings/cli/commands/shared_options.hpp"
#include "bindings/cli/commands/stored_results.hpp"
#include "bindings/cli/plain_streams.hpp"
#include "bindings/lua/registry/variation.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "engine/core/require.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::cli {

namespace {

constexpr int equal = done, different = failed;

// Versions may round differently.
void print_versions(const RecordedRun& recorded, const RecordedRun& again) {
  if (recorded.versions == again.versions) return;
  for (const auto& [name, version] : recorded.versions.members()) {
    const Json* now = again.versions.find(name);
    if (now != nullptr && *now == version) continue;
    std::printf("  %s was %s then, %s now\n", name.c_str(), version.text().c_str(),
                now != nullptr ? now->text().c_str() : "absent");
  }
}

// `^`, `math` and contacts over ranks may depend on the processor; engine results do not.
void print_machines(const RecordedRun& recorded, const RecordedRun& again) {
  for (const std::string& line : differing_machines(recorded.machine, again.machine))
    std::printf("  recorded on %s\n", line.c_str());
}

constexpr std::size_t most_shown = 10;

void print_differences(const std::vector<Difference>& found, const char* first, const char* second) {
  for (std::size_t k = 0; k < std::min(found.size(), most_shown); ++k)
    std::printf("  %s\n    %-8s  %s\n    %-8s  %s\n", found[k].where.c_str(), first,
                found[k].recorded.c_str(), second, found[k].again.c_str());
  if (found.size() > most_shown) std::printf("  and %zu more\n", found.size() - most_shown);
}

std::string differences_text(const std::vector<Difference>& found) {
  return found.size() == 1 ? "one difference" : std::to_string(found.size()) + " differences";
}

// Byte by byte. For another minor version: a line with this version, and differences of results.
std::vector<Difference> differences_from(const RecordedRun& recorded, const RecordedRun& again) {
  const std::string then = program_version(recorded), now = lua::version_text();
  if (same_minor_version(then, now)) return differences(recorded, again);
  AcrossVersions across = compare_across_versions(recorded, again);
  std::printf(
      "%s was recorded by %s, and this is %s; CHANGELOG.md lists the changes\n"
      "  %lld results compared to %s of their values\n",
      recorded.root.c_str(), then.empty() ? "a version without a name" : ("version " + then).c_str(),
      now.c_str(), static_cast<long long>(across.compared), format_short(digits_kept).c_str());
  return std::move(across.differences);
}

void show_variation(const RecordedRun& recorded, const std::filesystem::path& place,
                    const std::string& changed) {
  const std::vector<Difference> found = differences_from(recorded, read_run(place));
  std::printf("%s with %s: %s\n", recorded.root.c_str(), changed.c_str(),
              found.empty() ? "every result is the same" : differences_text(found).c_str());
  print_differences(found, "recorded", "varied");
}

// `altered`: files differ from the manifest.
int compare(const RecordedRun& recorded, const std::filesystem::path& place, bool altered) {
  const RecordedRun again = read_run(place);
  const std::vector<Difference> found = differences_from(recorded, again);
  const bool replayed = same_minor_version(program_version(recorded), lua::version_text());
  const char* const root = recorded.root.c_str();
  if (!found.empty()) {
    std::printf("%s: %s\n", root, differences_text(found).c_str());
    print_differences(found, "recorded", "now");
    print_versions(recorded, again);
    print_machines(recorded, again);
  } else if (replayed) {
    std::printf("%s: the same again, %zu lines of the journal%s\n", root,
                recorded.ended() ? recorded.journal.size() : again.journal.size(),
                !recorded.ended() ? ", as far as it had come"
                : altered         ? " and every file as the run wrote it"
                : recorded.left_pictures() || again.left_pictures()
                    ? " and every file but charts and pictures"
                    : " and every file");
  } else {
    std::printf("%s: the same results; only the version that recorded the run replays it to the byte\n",
                root);
  }
  return !replayed ? another_version : found.empty() ? equal : different;
}

std::shared_ptr<lua::Variation> variation_of(const ReplayCommand& command) {
  if (command.settings.empty()) return nullptr;
  auto variation = std::make_shared<lua::Variation>();
  for (const std::string& setting : command.settings) {
    if (setting.starts_with("knob.") || setting.starts_with("lab.knob."))
      refuse("`--set` is " + asperity::quoted(setting) + ", and a replay takes knobs as recorded",
             "run its script with --knob NAME=VALUE, and --reuse " + command.recorded +
                 " for unchanged results");
    variation->set(setting);
  }
  return variation;
}

// Returns the record's altered files.
std::vector<std::string> print_alterations(const RecordedRun& recorded) {
  std::vector<std::string> altered = altered_outputs(recorded);
  if (!recorded.journal_fault.empty()) altered.push_back(recorded.journal_fault);
  for (const std::string& sentence : altered) std::fprintf(stderr, "asperity: %s\n", sentence.c_str());
  if (!recorded.shard.empty() && recorded.status != "done")
    std::printf(
        "%s is shard %s of a run, and ends where the script needs the cases of the others; "
        "the replay computes all cases and compares until there\n",
        recorded.root.c_str(), recorded.shard.c_str());
  return altered;
}

RunCommand repetition_of(const RecordedRun& recorded, const ReplayCommand& command) {
  RunCommand run = command.run;
  load_as_recorded(run, recorded, true);
  run.arguments = recorded.arguments;
  run.knobs = recorded.knobs;
  run.seed = static_cast<std::uint64_t>(recorded.seed);
  if (command.from) {
    const auto lines = static_cast<std::int64_t>(recorded.journal.size());
    if (*command.from < 1 || *command.from > lines)
      refuse("`--from` is " + std::to_string(*command.from),
             "the journal of " + command.recorded + " has lines 1 to " + std::to_string(lines));
    run.afresh_from = command.from;
    run.reuse.push_back(command.recorded);
  }
  run.variation = variation_of(command);
  return run;
}

CommandReader declare_replay(CLI::App& options, BehindBarriers<ReplayCommand> barriers) {
  const auto given = std::make_shared<ReplayCommand>();
  ReplayCommand& asked = *given;
  options.add_option("run", asked.recorded, "the directory of the run")->required();
  options.add_option("--from", asked.from,
                     "take the results of heavy calls before this line of its journal from its store, and "
                     "compute from there on");
  options
      .add_option("--set", asked.settings,
                  "key=value or call.key=value: another value where calls give this key (from --from on), "
                  "e.g. --set press.pressure=\"200 MPa\"; may be given again")
      ->allow_extra_args(false);
  add_run_options(options, asked.run);
  add_trust(options, asked.run.trust);
  add_confinement(options, asked.run);
  add_seconds(options, "--limit-time", asked.run.limit_time, "end it after this long, e.g. 60s or \"2 min\"");
  options.footer(
      "Every call, row, expectation and file is compared by its digest; times and dates are not. Exit status "
      "1 if anything differs. A run recorded by another minor version is repeated too: its rows and verdicts "
      "are compared to 1e-05 of their values, and the exit status is 3. The script's own output is dropped.");

  return [given, barriers]() -> CommandWork {
    given->run.confined = barriers.wanted(*given);
    check_confinement(given->run);
    return
        [given, barriers] { return given->run.confined ? barriers.carry_out(*given) : cli::replay(*given); };
  };
}

}  // namespace

Command replay_command(BehindBarriers<ReplayCommand> barriers) {
  return {.name = "replay",
          .sentence =
              "run the script of a recorded run again, with its arguments and seed, and compare every result",
          .overview = "asperity replay RUN                            run a recorded run again and compare\n",
          .declare = [barriers](CLI::App& options) { return declare_replay(options, barriers); }};
}

int replay(const ReplayCommand& command) {
  const RecordedRun recorded = read_run(command.recorded);
  require_repeatable(command.run, recorded, "replay");
  const std::vector<std::string> altered = print_alterations(recorded);
  const RunCommand run = repetition_of(recorded, command);
  lua::Variation* const variation = run.variation.get();
  std::filesystem::path place;
  const auto verdict = [&](int ended) {
    try {
      if (variation != nullptr) {
        variation->check_all_met();
        show_variation(recorded, place, variation->text());
        return ended;
      }
      const int status = compare(recorded, place, !altered.empty());
      return altered.empty() ? status : different;
    } catch (const Error& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
      return different;
    }
  };
  std::optional<Muted> muted(std::in_place);
  const int status = in_run_directory(run, [&](RunContext& context) {
    place = context.run->path();
    if (variation != nullptr && command.from)
      variation->in_force = [journal = &context.run->journal(), from = *command.from] {
        return journal->count() + 1 >= from;
      };
    if (variation != nullptr) context.run->note("variation", Json::strings(command.settings));
    return run_script(context, [&](int code) {
      muted.reset();
      return verdict(code);
    });
  });
  muted.reset();
  // No run, or an interrupted one.
  if (place.empty() || status > different) return status;
  return verdict(status);
}

}  // namespace asperity::cli
