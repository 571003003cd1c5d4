// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/kept_results.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/build_identity.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/experiment/recorded_run.hpp"
#include "engine/experiment/run_directory.hpp"

namespace asperity::cli {

namespace {

// A run directory keeps its results in `store`; a folder of results is named itself.
std::filesystem::path results_of(const std::string& named) {
  const std::filesystem::path folder(named);
  std::error_code problem;
  if (!std::filesystem::is_directory(folder, problem))
    throw Error(ErrorCode::bad_value, "`--reuse` names " + asperity::quoted(named) + ", which is no folder",
                "give the directory of a run");
  return std::filesystem::exists(folder / "manifest.json", problem) ? folder / "store" : folder;
}

}  // namespace

void require_repeatable(const RunCommand& command, const RecordedRun& recorded, const char* purpose) {
  if (recorded.manifest.find("prompt") != nullptr)
    throw Error(ErrorCode::bad_value,
                asperity::quoted(recorded.root.string()) +
                    " is a session of the prompt, whose journal begins with its first file",
                "its lines run again by `asperity run " + (recorded.root / "script.lua").string() + "`");
  if (command.trust == recorded.trusted) return;
  if (recorded.trusted)
    throw Error(
        ErrorCode::bad_value,
        asperity::quoted(recorded.root.string()) +
            " was recorded with `--trust`, which gives its script the whole of Lua and files anywhere",
        std::string("add `--trust` to ") + purpose + " it so");
  throw Error(ErrorCode::bad_value,
              asperity::quoted(recorded.root.string()) + " was recorded without `--trust`",
              std::string("leave `--trust` out to ") + purpose + " it as it was");
}

ResultFilesSetup result_files(const RunCommand& command) {
  ResultFilesSetup setup;
  for (const std::string& named : command.reuse) setup.also.push_back(results_of(named));
  if (command.store) {
    setup.folder = *command.store;
    setup.most_bytes = unlimited;
  }
  if (command.store_limit) setup.most_bytes = *command.store_limit;
  setup.build = build_identity();
  return setup;
}

std::optional<RunCommand> taken_up(RunCommand command) {
  namespace fs = std::filesystem;
  const fs::path root(*command.resume);
  std::error_code problem;
  if (!fs::exists(root, problem) || (fs::is_directory(root, problem) && fs::is_empty(root, problem))) {
    if (command.script.empty())
      throw Error(ErrorCode::bad_file, "there is no run " + asperity::quoted(*command.resume) + " to resume",
                  "give the script to begin it with");
    command.out = command.resume;
    command.resume.reset();
    return command;
  }
  const RecordedRun recorded = read_run(root);
  std::vector<std::string> changed;
  if (!command.script.empty() &&
      (command.text ? *command.text : read_script(command.script)) != recorded.script_text)
    changed.emplace_back("the script");
  if (!command.arguments.empty() && command.arguments != recorded.arguments)
    changed.emplace_back("its arguments");
  if (command.seed_given && static_cast<std::int64_t>(command.seed) != recorded.seed)
    changed.emplace_back("the seed");
  if (!changed.empty() && command.reuse.empty())
    throw Error(ErrorCode::bad_value,
                joined(changed, " and ") + " of " + asperity::quoted(*command.resume) +
                    (changed.size() > 1 ? " are" : " is") + " not the one given now",
                "leave it out to go on as recorded, or add `--reuse " + *command.resume +
                    "` to begin anew there with the results that are still the same");
  command.anew = !changed.empty();
  if (command.anew) return command;
  if (recorded.status == "done") return {};
  require_repeatable(command, recorded, "go on with");
  command.script = recorded.script_path;
  command.text = recorded.script_text;
  command.arguments = recorded.arguments;
  command.seed = static_cast<std::uint64_t>(recorded.seed);
  return command;
}

}  // namespace asperity::cli
