// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/stored_results.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "bindings/lua/runtime/version.hpp"
#include "engine/core/program_identity.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity::cli {

namespace {

// `store` of a run directory, or the folder itself.
std::filesystem::path results_of(const std::string& named) {
  const std::filesystem::path folder(named);
  std::error_code problem;
  if (!std::filesystem::is_directory(folder, problem))
    refuse("`--reuse` names " + asperity::quoted(named) + ", which is no folder",
           "give the directory of a run");
  const std::filesystem::path store = folder / run_names::store;
  const bool is_run = std::filesystem::exists(folder / run_names::manifest, problem) ||
                      std::filesystem::exists(std::filesystem::symlink_status(store, problem));
  if (!is_run) return folder;
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(store, problem)))
    refuse(asperity::quoted(store.string()) + " is a link",
           "name the folder of results itself with `--reuse`");
  return store;
}

RunCommand begun_there(RunCommand command) {
  if (command.script.empty())
    refuse_bad_file("there is no run " + asperity::quoted(*command.resume) + " to resume",
                    "give the script to begin it with");
  command.out = std::exchange(command.resume, std::nullopt);
  return command;
}

// After a crash while moving an earlier run aside.
bool holds_earlier_run(const std::filesystem::path& root) {
  std::error_code problem;
  if (std::filesystem::exists(std::filesystem::symlink_status(root / run_names::manifest, problem)))
    return false;
  for (std::filesystem::directory_iterator entry(root, problem), end; !problem && entry != end;
       entry.increment(problem))
    if (entry->path().filename().string().starts_with("before-")) return true;
  return false;
}

std::vector<std::string> damages_of(const RecordedRun& recorded) {
  std::vector<std::string> damages = altered_outputs(recorded);
  if (!recorded.journal_fault.empty()) damages.insert(damages.begin(), recorded.journal_fault);
  return damages;
}

std::vector<std::string> changes_of(const RunCommand& command, const RecordedRun& recorded) {
  std::vector<std::string> changed;
  if (!command.script.empty() &&
      (command.text ? *command.text : read_script(command.script)) != recorded.script_text)
    changed.emplace_back("the script");
  if (!command.arguments.empty() && command.arguments != recorded.arguments)
    changed.emplace_back("its arguments");
  if (command.seed_given && static_cast<std::int64_t>(command.seed) != recorded.seed)
    changed.emplace_back("the seed");
  const Json given = given_knobs_json(command.knobs);
  const Json then = given_knobs_json(recorded.knobs);
  for (const auto& [name, knob] : given.members())
    if (then[name] != knob) changed.push_back("the knob " + asperity::quoted(name));
  const std::string share = command.shard ? command.shard->text() : "";
  if ((command.shard || command.merge_only) && share != recorded.shard)
    changed.push_back("the share (" + (recorded.shard.empty() ? "all cases" : "shard " + recorded.shard) +
                      ")");
  return changed;
}

// A resumed run keeps its share and store. A confined run takes no folder from a record of unknown origin.
void take_share(RunCommand& command, const RecordedRun& recorded) {
  if (recorded.store.empty()) return;
  if (!command.barriers.is_null() && !command.store)
    refuse(asperity::quoted(recorded.root.string()) + " shares the folder " +
               asperity::quoted(recorded.store) + ", which a confined run does not take from a record",
           "give it by --store");
  if (!command.store) command.store = recorded.store;
  if (!command.shard && !recorded.shard.empty()) command.shard = parse_shard(recorded.shard);
}

// Another version has other rounding and laws.
void require_same_version(const RecordedRun& recorded) {
  const std::string version = program_version(recorded);
  if (version == lua::version_text()) return;
  const std::string run = asperity::quoted(recorded.root.string());
  const std::string by = version.empty() ? "a version it does not name" : "version " + version;
  const std::string begins_anew = "add `--reuse " + recorded.root.string() + "` to begin anew there";
  if (recorded.status == "done")
    refuse(joined(damages_of(recorded), "; ") + "; " + run + " was recorded by " + by + ", and this is " +
               lua::version_text() + ", which may give other bytes",
           "restore it with the version that recorded it, or " + begins_anew);
  refuse(run + " was begun by " + by + ", and this is " + lua::version_text() +
             ": one record cannot hold two versions",
         "go on with the version that began it, or " + begins_anew);
}

void require_unchanged(const std::vector<std::string>& changed, const std::string& run) {
  if (changed.empty()) return;
  refuse(joined(changed, " and ") + " of " + asperity::quoted(run) + (changed.size() > 1 ? " are" : " is") +
             " not the one given now",
         "leave it out to resume as recorded, or add `--reuse " + run +
             "` to begin anew there with the unchanged results");
}

// Returns false for a complete run.
bool note_damages(RunCommand& command, const RecordedRun& recorded) {
  const std::filesystem::path journal = recorded.root / run_names::journal;
  if (recorded.status == "done") {
    command.damages = damages_of(recorded);
    command.journal_lost = !recorded.journal_fault.empty();
    return !command.damages.empty();
  }
  // Failed cases may succeed now: a new journal from script and store.
  const bool rebuilt = !recorded.shard.empty() || (recorded.status == "failed" && !recorded.store.empty());
  const bool damaged =
      !rebuilt &&
      (!std::filesystem::exists(journal) ||
       (recorded.ended() && !recorded.journal_fault.empty() && std::filesystem::is_regular_file(journal)));
  if (damaged) command.damages = {recorded.journal_fault};
  if (rebuilt || damaged)
    command.journal_lost = true;
  else if (!recorded.journal_hint.empty())
    refuse_bad_file(recorded.journal_fault, recorded.journal_hint);
  return true;
}

}  // namespace

void require_repeatable(const RunCommand& command, const RecordedRun& recorded, const char* purpose) {
  if (recorded.manifest.find("prompt") != nullptr)
    refuse(asperity::quoted(recorded.root.string()) + " is a session of the prompt, without a whole journal",
           "run its lines again by `asperity run " + (recorded.root / run_names::script).string() + "`");
  if (command.trust == recorded.trusted) return;
  if (recorded.trusted)
    refuse(asperity::quoted(recorded.root.string()) + " was recorded with `--trust`",
           std::string("add `--trust` to ") + purpose + " it so");
  refuse(asperity::quoted(recorded.root.string()) + " was recorded without `--trust`",
         std::string("leave `--trust` out to ") + purpose + " it as it was");
}

void load_as_recorded(RunCommand& command, const RecordedRun& recorded, bool tell) {
  command.script = recorded.script_path;
  command.text = recorded.script_text;
  command.loaded = std::make_shared<const LoadedFiles>(recorded.loaded);
  if (!tell) return;
  for (const std::string& sentence : altered_originals(recorded))
    std::fprintf(stderr, "asperity: %s\n", sentence.c_str());
}

ResultFilesSetup result_files(const RunCommand& command) {
  ResultFilesSetup setup;
  for (const std::string& named : command.reuse) setup.also.push_back(results_of(named));
  if (command.store) {
    setup.folder = *command.store;
    setup.most_bytes = unlimited;
    if (command.limit_disk) setup.most_added = *command.limit_disk;
  }
  if (command.store_limit) setup.most_bytes = *command.store_limit;
  setup.build = build_identity();
  return setup;
}

std::optional<RunCommand> taken_up(RunCommand command, bool leads) {
  const std::filesystem::path root(*command.resume);
  if (is_not_begun(root)) return begun_there(std::move(command));
  if (holds_earlier_run(root)) {
    if (!leads) return begun_there(std::move(command));
    if (command.lock == nullptr) command.lock = RunLock::take(root);
    finish_moving_aside(root);
    if (is_not_begun(root)) return begun_there(std::move(command));
  }
  refuse_links(root);
  RecordedRun recorded = read_run(root, true);
  // Complete: neither written nor locked.
  if (recorded.status == "done" && changes_of(command, recorded).empty() && damages_of(recorded).empty())
    return {};
  if (command.reuse.empty()) require_same_version(recorded);
  if (leads && command.lock == nullptr) {
    command.lock = RunLock::take(root);
    recorded = read_run(root, true);  // after the last holder of the lock
    if (command.reuse.empty()) require_same_version(recorded);
  }
  const std::vector<std::string> changed = changes_of(command, recorded);
  if (command.reuse.empty()) require_unchanged(changed, *command.resume);
  take_share(command, recorded);
  command.anew = !changed.empty() || program_version(recorded) != lua::version_text();
  if (command.anew && !command.script.empty()) return command;
  if (!command.anew && !note_damages(command, recorded)) return {};
  require_repeatable(command, recorded, command.anew ? "begin it anew" : "go on with");
  load_as_recorded(command, recorded, leads);
  if (command.arguments.empty()) command.arguments = recorded.arguments;
  if (!command.seed_given) command.seed = static_cast<std::uint64_t>(recorded.seed);
  if (!command.anew) command.knobs.clear();
  command.knobs.insert(recorded.knobs.begin(), recorded.knobs.end());
  return command;
}

}  // namespace asperity::cli
