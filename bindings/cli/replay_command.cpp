// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/replay_command.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "bindings/cli/exit_status.hpp"
#include "bindings/cli/kept_results.hpp"
#include "bindings/cli/muted.hpp"
#include "bindings/lua/variation.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/recorded_run.hpp"
#include "engine/experiment/run_directory.hpp"
#include "engine/experiment/run_facts.hpp"

namespace asperity::cli {

namespace {

constexpr int equal = done, different = failed;

// Programs or libraries of another version may round otherwise.
void print_versions(const RecordedRun& recorded, const RecordedRun& again) {
  if (recorded.versions == again.versions) return;
  for (const auto& [name, version] : recorded.versions.members()) {
    const Json* now = again.versions.find(name);
    if (now != nullptr && *now == version) continue;
    std::printf("  %s was %s then, %s now\n", name.c_str(), version.text().c_str(),
                now != nullptr ? now->text().c_str() : "absent");
  }
}

// The engine's results are the same bits on every processor; what the script computes by `^` and `math`, and
// contacts spread over ranks, may not be.
void print_machines(const RecordedRun& recorded, const RecordedRun& again) {
  const auto machine_of = [](const RecordedRun& run) -> const Json* {
    const Json* unhashed = run.manifest.find("unhashed");
    return unhashed != nullptr ? unhashed->find("machine") : nullptr;
  };
  const Json *then = machine_of(recorded), *now = machine_of(again);
  if (then == nullptr || now == nullptr) return;
  for (const std::string& line : differing_machines(*then, *now))
    std::printf("  recorded on %s\n", line.c_str());
}

void print_differences(const std::vector<Difference>& found, const char* first, const char* second) {
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(found.size(), most); ++k)
    std::printf("  %s\n    %-8s  %s\n    %-8s  %s\n", found[k].where.c_str(), first,
                found[k].recorded.c_str(), second, found[k].again.c_str());
  if (found.size() > most) std::printf("  and %zu more\n", found.size() - most);
}

// Prints what came out otherwise.
void show_variation(const RecordedRun& recorded, const std::filesystem::path& place,
                    const std::string& what) {
  const std::vector<Difference> found = differences(recorded, read_run(place));
  std::printf("%s with %s: %s\n", recorded.root.c_str(), what.c_str(),
              found.empty()       ? "nothing came out otherwise"
              : found.size() == 1 ? "one difference"
                                  : (std::to_string(found.size()) + " differences").c_str());
  print_differences(found, "recorded", "varied");
}

// Prints how the two compare; the exit status. `altered`: files of the record are not what the run wrote.
int compare(const RecordedRun& recorded, const std::filesystem::path& place, bool altered) {
  const RecordedRun again = read_run(place);
  const std::vector<Difference> found = differences(recorded, again);
  if (found.empty()) {
    std::printf("%s: the same again, %zu lines of the journal%s\n", recorded.root.c_str(),
                recorded.ended() ? recorded.journal.size() : again.journal.size(),
                !recorded.ended() ? ", as far as it had come"
                : altered         ? " and every file as the run wrote it"
                                  : " and every file");
    return equal;
  }
  std::printf("%s: %s\n", recorded.root.c_str(),
              (found.size() == 1 ? "one difference" : std::to_string(found.size()) + " differences").c_str());
  print_differences(found, "recorded", "now");
  print_versions(recorded, again);
  print_machines(recorded, again);
  return different;
}

}  // namespace

int replay(const ReplayCommand& command) {
  std::optional<RecordedRun> recorded;
  try {
    recorded = read_run(command.recorded);
    require_repeatable(command.run, *recorded, "replay");
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }
  std::vector<std::string> altered = altered_outputs(*recorded);
  if (!recorded->journal_fault.empty()) altered.push_back(recorded->journal_fault);
  for (const std::string& sentence : altered) std::fprintf(stderr, "asperity: %s\n", sentence.c_str());

  RunCommand run = command.run;
  run.script = recorded->script_path;
  run.text = recorded->script_text;
  run.arguments = recorded->arguments;
  run.seed = static_cast<std::uint64_t>(recorded->seed);
  const auto lines = static_cast<std::int64_t>(recorded->journal.size());
  if (command.from && (*command.from < 1 || *command.from > lines)) {
    std::fprintf(stderr, "asperity: `--from` is %lld; the journal of %s has lines 1 to %lld\n",
                 static_cast<long long>(*command.from), command.recorded.c_str(),
                 static_cast<long long>(lines));
    return bad_usage;
  }
  if (command.from) {
    run.afresh_from = command.from;
    run.reuse.push_back(command.recorded);
  }
  std::shared_ptr<lua::Variation> variation;
  try {
    if (!command.settings.empty()) variation = std::make_shared<lua::Variation>();
    for (const std::string& setting : command.settings) variation->set(setting);
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }
  run.variation = variation;
  std::filesystem::path place;
  const auto verdict = [&](int ended) {
    try {
      if (variation) {
        variation->check_all_met();
        show_variation(*recorded, place, variation->text());
        return ended;
      }
      const int status = compare(*recorded, place, !altered.empty());
      return altered.empty() ? status : different;
    } catch (const Error& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
      return different;
    }
  };
  std::optional<Muted> muted(std::in_place);
  const int status = in_run_directory(run, [&](RunContext& context) {
    place = context.run->path();
    if (variation && command.from)
      variation->in_force = [journal = &context.run->journal(), from = *command.from] {
        return journal->count() + 1 >= from;
      };
    if (variation) context.run->note("variation", Json::strings(command.settings));
    return run_script(context, [&](int code) {
      muted.reset();
      return verdict(code);
    });
  });
  muted.reset();
  // Nothing was run, or it was stopped on the way.
  if (place.empty() || status > different) return status;
  return verdict(status);
}

}  // namespace asperity::cli
