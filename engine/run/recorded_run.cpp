// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/recorded_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/run/journal.hpp"
#include "engine/run/run_facts.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr const char* unhashed = "unhashed";

const Json& member(const Json& record, std::string_view name, const fs::path& file) {
  if (const Json* found = record.find(name)) return *found;
  refuse_bad_file(quoted(file.string()) + " has no `" + std::string(name) + "`",
                  "it is not the record of a run, or it was altered");
}

std::string described(const Json& line) {
  for (const char* name : {"function", "notebook", "event"})
    if (const Json* value = line.find(name)) return value->string();
  return "";
}

void compare_lines(const RecordedRun& recorded, const RecordedRun& again, std::vector<Difference>& found) {
  std::size_t compared = std::max(recorded.journal.size(), again.journal.size());
  if (!recorded.ended()) {
    compared = recorded.journal.size();
    // An unfinished run's end is no result.
    if (compared > 0 && described(recorded.journal.back()) == "end") --compared;
  }
  for (std::size_t k = 0; k < compared; ++k) {
    const Json* one = k < recorded.journal.size() ? &recorded.journal[k] : nullptr;
    const Json* other = k < again.journal.size() ? &again.journal[k] : nullptr;
    if (one != nullptr && other != nullptr && *one == *other) continue;
    found.push_back(
        difference_of("line " + std::to_string(k + 1) + ", " + described(one != nullptr ? *one : *other),
                      differing_members(one, other)));
  }
}

struct ListedFile {
  std::string file;
  const Json *digest, *copy;  // null if missing
};

// Without entries that name no file.
std::vector<ListedFile> files_in(const Json* list) {
  std::vector<ListedFile> files;
  if (list == nullptr) return files;
  for (const Json& entry : list->list())
    if (const Json* file = entry.find("file"))
      files.push_back({file->string(), entry.find("digest"), entry.find("copy")});
  return files;
}

// A foreign record may name only its own copies.
void read_loaded(RecordedRun& run) {
  for (const auto& [file, digest, copy] : files_in(&run.inputs)) {
    if (copy == nullptr || digest == nullptr) continue;
    const fs::path inside(copy->string()), place = run.root / inside;
    std::error_code missing;
    if (inside.parent_path() != run_names::loaded ||
        !fs::is_regular_file(fs::symlink_status(place, missing))) {
      run.loaded_fault.push_back(quoted(inside.string()) + " is missing from the run");
      continue;
    }
    LoadedFile loaded{text_of_run_file(place), digest->string()};
    if (content_digest(loaded.text) == loaded.digest)
      run.loaded.emplace(file, std::move(loaded));
    else
      run.loaded_fault.push_back(quoted(inside.string()) + " was altered since the run");
  }
}

bool is_picture(const fs::path& file) {
  constexpr std::array<std::string_view, 3> endings{".svg", ".png", ".pdf"};
  return std::ranges::find(endings, file.extension().string()) != endings.end();
}

void compare_files(const RecordedRun& recorded, const RecordedRun& again, std::string_view list,
                   std::vector<Difference>& found) {
  const auto digest_in = [&](const RecordedRun& run, const std::string& file) -> const Json* {
    for (const ListedFile& listed : files_in(run.manifest.find(list)))
      if (listed.file == file) return listed.digest;
    return nullptr;
  };
  std::vector<std::string> files;
  for (const RecordedRun* run : {&recorded, &again})
    for (const ListedFile& listed : files_in(run->manifest.find(list)))
      if (std::ranges::find(files, listed.file) == files.end()) files.push_back(listed.file);
  const std::string kind(list.substr(0, list.size() - 1));  // "outputs" -> "output"
  for (const std::string& file : files) {
    const Json *one = digest_in(recorded, file), *other = digest_in(again, file);
    if (one != nullptr && other != nullptr && *one == *other) continue;
    const RecordedRun& lacking = one == nullptr ? recorded : again;
    if ((one == nullptr || other == nullptr) && is_picture(file) && lacking.left_pictures()) continue;
    found.push_back({kind + " " + quoted(file), brief(one), brief(other)});
  }
}

constexpr double rounding_of_column = 1e-12;

// Rows of one notebook, or verdicts of its expectations, in journal order.
struct Results {
  std::string name;                          // "events, row"
  std::vector<const Json*> entries{};        // objects
  std::map<std::string, double> greatest{};  // by column of numbers
};

std::vector<Results> results_in(const std::vector<Json>& journal) {
  std::vector<Results> all;
  for (const Json& line : journal) {
    const Json *row = line.find("row"), &notebook = line["notebook"];
    const bool is_verdict = row == nullptr && line.find("passed") != nullptr;
    if (!notebook.is_string() || !(is_verdict || (row != nullptr && row->is_object()))) continue;
    const std::string name = notebook.string() + (is_verdict ? ", expectation" : ", row");
    auto place = std::ranges::find(all, name, &Results::name);
    if (place == all.end()) place = all.insert(all.end(), Results{name});
    place->entries.push_back(is_verdict ? &line : row);
    if (is_verdict) continue;
    for (const auto& [column, value] : row->members())
      if (value.is_number())
        place->greatest[column] = std::max(place->greatest[column], std::abs(value.number()));
  }
  return all;
}

bool agree(const Json& one, const Json& other, double greatest) {
  if (!one.is_number() || !other.is_number()) return one == other;
  const double a = one.number(), b = other.number();
  return a == b || std::abs(a - b) <= std::max(digits_kept * std::max(std::abs(a), std::abs(b)),
                                               rounding_of_column * greatest);
}

}  // namespace

Difference difference_of(std::string where, const std::vector<DifferingMember>& members) {
  const auto join_path = [&](const std::string& path) { return path.empty() ? where : where + ", " + path; };
  if (members.size() == 1)
    return {join_path(members[0].path), brief(members[0].one), brief(members[0].other)};
  const auto list = [&](const Json* DifferingMember::*side) {
    constexpr std::size_t most = 6;
    std::string text;
    for (std::size_t k = 0; k < std::min(members.size(), most); ++k)
      text += (k > 0 ? ", " : "") + members[k].path + " " + brief(members[k].*side);
    return members.size() > most ? text + " …" : text;
  };
  return {std::move(where), list(&DifferingMember::one), list(&DifferingMember::other)};
}

std::string program_version(const RecordedRun& run) {
  const Json& version = run.versions["asperity"];
  return version.is_string() ? version.string() : std::string();
}

Json read_manifest(const fs::path& root) {
  const fs::path file = root / run_names::manifest;
  return Json::parse(text_of_run_file(file), quoted(file.string()));
}

RecordedRun read_run(const fs::path& root, bool journal_may_be_damaged) {
  RecordedRun run;
  run.root = root;
  const fs::path file = root / run_names::manifest;
  const Json manifest = read_manifest(root);
  run.status = member(manifest, "status", file).string();
  const Json& script = member(manifest, "script", file);
  const Json& rest = member(manifest, unhashed, file);
  run.script_path = member(rest, "script_path", file).string();
  run.script_text = text_of_run_file(root / run_names::script);
  const std::string digest = Digester().add(run.script_text).hex();
  if (digest != member(script, "digest", file).string())
    refuse_bad_file(quoted((root / run_names::script).string()) + " is not the script that ran",
                    "it was altered since; run it as a script of its own");
  for (const Json& argument : member(manifest, "arguments", file).list())
    run.arguments.push_back(argument.string());
  run.seed = static_cast<std::int64_t>(member(manifest, "seed", file).number());
  if (const Json* knobs = manifest.find("knobs")) run.knobs = given_knobs(*knobs);
  run.trusted = member(manifest, "trusted", file).boolean();
  run.versions = member(manifest, "versions", file);
  if (const Json* machine = rest.find("machine")) run.machine = *machine;
  for (const auto& [name, text] : {std::pair("shard", &run.shard), std::pair("store", &run.store)})
    if (const Json* found = rest.find(name)) *text = found->string();
  run.manifest = without(manifest);
  const Json* inputs = manifest.find("inputs");
  if (inputs == nullptr) inputs = rest.find(run_names::inputs_so_far);
  if (inputs != nullptr) run.inputs = *inputs;
  read_loaded(run);
  try {
    run.journal = read_journal(root / run_names::journal, !run.ended()).lines;
  } catch (const Error& error) {
    if (!journal_may_be_damaged) throw;
    run.journal_fault = error.sentence();
    run.journal_hint = error.hint();
    return run;
  }
  const Json* facts = run.manifest.find("journal");
  if (!run.ended() || facts == nullptr) return run;
  const JournalFacts now = facts_of(run.journal);
  if (!(member(*facts, "digest", file) == Json(now.digest)))
    run.journal_fault = quoted((root / run_names::journal).string()) + " was altered since the run";
  return run;
}

std::vector<std::string> altered_outputs(const RecordedRun& run) {
  std::vector<std::string> sentences = run.loaded_fault;
  for (const auto& [file, digest, copy] : files_in(run.manifest.find("outputs"))) {
    if (digest == nullptr) continue;
    const fs::path place = run.root / file;
    std::error_code missing;
    if (!fs::is_regular_file(place, missing))
      sentences.push_back(quoted(file) + " is missing from the run");
    else if (file_digest(place) != digest->string())
      sentences.push_back(quoted(file) + " was altered since the run");
  }
  return sentences;
}

std::vector<std::string> altered_inputs(const RecordedRun& run) {
  std::vector<std::string> sentences;
  const Json* inputs = run.ended() ? run.manifest.find("inputs") : nullptr;
  if (inputs == nullptr) return sentences;
  for (const auto& [file, digest, copy] : files_in(inputs)) {
    if (digest == nullptr || copy != nullptr) continue;
    bool found = false, same = false;
    for (const fs::path& place : {fs::path(file), run.root / file}) {
      std::error_code missing;
      if (same || !fs::is_regular_file(place, missing)) continue;
      found = true;
      same = file_digest(place) == digest->string();
    }
    if (!same)
      sentences.push_back(
          "\"" + plain_text(file) + "\"" +
          (found ? " has changed since the run read it" : ", an input of the run, is not found here"));
  }
  for (std::string& sentence : altered_originals(run)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::vector<std::string> altered_originals(const RecordedRun& run) {
  std::vector<std::string> sentences;
  for (const auto& [file, loaded] : run.loaded) {
    std::error_code missing;
    if (fs::is_regular_file(file, missing) && file_digest(file) != loaded.digest)
      sentences.push_back("\"" + plain_text(file) +
                          "\" has changed since the run loaded it; the run's own copy is used");
  }
  return sentences;
}

std::vector<Difference> differences(const RecordedRun& recorded, const RecordedRun& again) {
  std::vector<Difference> found;
  if (recorded.ended()) compare_files(recorded, again, "inputs", found);
  compare_lines(recorded, again, found);
  if (!recorded.ended()) return found;
  compare_files(recorded, again, "outputs", found);
  const Json *one = recorded.manifest.find("expectations"), *other = again.manifest.find("expectations");
  if (!(recorded.manifest["expectations"] == again.manifest["expectations"]))
    found.push_back({"expectations", brief(one), brief(other)});
  return found;
}

bool same_minor_version(std::string_view one, std::string_view other) {
  const auto minor = [](std::string_view version) { return version.substr(0, version.rfind('.')); };
  return one == other || (std::count(one.begin(), one.end(), '.') == 2 && minor(one) == minor(other));
}

AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again) {
  AcrossVersions result;
  const std::vector<Results> now = results_in(again.journal);
  for (const Results& then : results_in(recorded.journal)) {
    const auto place = std::ranges::find(now, then.name, &Results::name);
    const std::size_t count = then.entries.size(),
                      again_count = place != now.end() ? place->entries.size() : 0;
    const bool verdicts = then.name.ends_with(", expectation");
    for (std::size_t k = 0; k < std::min(count, again_count); ++k)
      for (const auto& [column, value] : then.entries[k]->members()) {
        if (verdicts && column != "passed") continue;
        const Json* other = place->entries[k]->find(column);
        const auto greatest = then.greatest.find(column);
        ++result.compared;
        if (other == nullptr || !agree(value, *other, greatest != then.greatest.end() ? greatest->second : 0))
          result.differences.push_back(
              {then.name + " " + std::to_string(k + 1) + ", " + column, brief(&value), brief(other)});
      }
    if (again_count < count || (recorded.ended() && again_count > count))
      result.differences.push_back({then.name + "s", std::to_string(count), std::to_string(again_count)});
  }
  return result;
}

}  // namespace asperity
