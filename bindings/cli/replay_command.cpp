// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/replay_command.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "bindings/cli/muted.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/recorded_run.hpp"
#include "engine/experiment/run_directory.hpp"

namespace asperity::cli {

namespace {

constexpr int equal = 0, different = 1, bad_usage = 2;

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

// Prints how the two compare; the exit status.
int compare(const RecordedRun& recorded, const std::filesystem::path& place) {
  const RecordedRun again = read_run(place);
  const std::vector<Difference> found = differences(recorded, again);
  if (found.empty()) {
    std::printf("%s: the same again, %zu lines of the journal%s\n", recorded.root.c_str(),
                recorded.ended() ? recorded.journal.size() : again.journal.size(),
                recorded.ended() ? " and every file" : ", as far as it had come");
    return equal;
  }
  std::printf("%s: %s\n", recorded.root.c_str(),
              (found.size() == 1 ? "one difference" : std::to_string(found.size()) + " differences").c_str());
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(found.size(), most); ++k)
    std::printf("  %s\n    recorded  %s\n    now       %s\n", found[k].where.c_str(),
                found[k].recorded.c_str(), found[k].again.c_str());
  if (found.size() > most) std::printf("  and %zu more\n", found.size() - most);
  print_versions(recorded, again);
  return different;
}

}  // namespace

int replay(const ReplayCommand& command) {
  std::optional<RecordedRun> recorded;
  try {
    recorded = read_run(command.recorded);
  } catch (const Error& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    return bad_usage;
  }
  const std::vector<std::string> altered = altered_outputs(*recorded);
  for (const std::string& sentence : altered) std::fprintf(stderr, "asperity: %s\n", sentence.c_str());

  RunCommand run = command.run;
  run.script = recorded->script_path;
  run.text = recorded->script_text;
  run.arguments = recorded->arguments;
  run.seed = static_cast<std::uint64_t>(recorded->seed);
  run.trust = recorded->trusted;
  std::filesystem::path place;
  const auto verdict = [&](int) {
    try {
      const int status = compare(*recorded, place);
      return altered.empty() ? status : different;
    } catch (const Error& error) {
      std::fprintf(stderr, "asperity: %s\n", error.what());
      return different;
    }
  };
  std::optional<Muted> muted(std::in_place);
  const int status = in_run_directory(run, [&](RunContext& context) {
    place = context.run->path();
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
