// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/shared_options.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

#include "engine/core/files/source_file.hpp"
#include "engine/core/require.hpp"

namespace asperity::cli {

namespace {

double seconds_of(const std::string& text) {
  try {
    const Quantity q = parse_quantity(text);
    if ((q.dimension == dimension::time || q.dimension == dimension::number) && q.value > 0) return q.value;
  } catch (const Error&) {
  }
  refuse("a time limit is " + asperity::quoted(text), "give a time such as 60s or \"2 min\"");
}

std::int64_t bytes_of(const std::string& text, const std::string& limit) {
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  std::string unit = text.substr(used);
  if (unit.ends_with("iB")) unit.resize(unit.size() - 2);
  if (unit == "B") unit.clear();
  double factor = unit.empty()                 ? 1
                  : unit == "K" || unit == "k" ? 0x1p10
                  : unit == "M"                ? 0x1p20
                  : unit == "G"                ? 0x1p30
                  : unit == "T"                ? 0x1p40
                                               : 0;
  if (used == 0 || factor == 0 || !(value * factor >= 1 && value * factor < 0x1p62))
    refuse(limit + " is " + asperity::quoted(text), "give bytes such as 512M or 4G");
  return static_cast<std::int64_t>(value * factor);
}

Shard from_slurm() {
  const auto read = [&](const char* name) -> long {
    const char* const text = std::getenv(name);
    if (text == nullptr)
      refuse(
          "`--shard slurm` reads " + std::string(name) + ", which is not set: this is no task of a job array",
          "submit it with sbatch --array=1-N, or give --shard i/n");
    const std::optional<std::uint64_t> value = count_in(text);
    if (!value)
      refuse(std::string(name) + " is " + asperity::quoted(std::string_view(text)) + ", no whole number");
    return static_cast<long>(*value);
  };
  const long id = read("SLURM_ARRAY_TASK_ID"), count = read("SLURM_ARRAY_TASK_COUNT");
  const long first = std::getenv("SLURM_ARRAY_TASK_MIN") != nullptr ? read("SLURM_ARRAY_TASK_MIN") : 1;
  const long last =
      std::getenv("SLURM_ARRAY_TASK_MAX") != nullptr ? read("SLURM_ARRAY_TASK_MAX") : first + count - 1;
  const long index = id - first + 1;
  // A resubmitted task does not know the first array's size.
  const bool whole = (first == 0 || first == 1) && last - first + 1 == count;
  if (!whole || count > 1'000'000 || index < 1 || index > count)
    refuse("task " + std::to_string(id) + " of a job array of " + std::to_string(count) + " from " +
               std::to_string(first) + " to " + std::to_string(last) + " is none of its shards",
           "number all tasks one after the other, as in sbatch --array=1-" +
               std::to_string(std::max(count < 1 ? 4 : count, last)) +
               "; for some of them alone, give --shard i/n");
  return {static_cast<int>(index), static_cast<int>(count)};
}

void read_knob(GivenKnobs& knobs, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse("`--knob` is " + asperity::quoted(text),
           "give a name and its value, as in --knob pressure=\"50 MPa\"");
  try {
    give_knob(knobs, text.substr(0, equals), text.substr(equals + 1));
  } catch (const Error& error) {
    throw Error(error.code(), "`--knob`: " + error.sentence(), error.hint());
  }
}

// "17", or "2.17": second ensemble.
CaseNumber parse_case(const std::string& text) {
  const std::size_t dot = text.find('.');
  const auto ensemble =
      dot == std::string::npos ? std::uint64_t{1} : count_in(text.substr(0, dot)).value_or(0);
  const auto number = count_in(text.substr(dot + 1)).value_or(0);  // without a dot, all
  if (ensemble >= 1 && ensemble <= std::numeric_limits<int>::max() && number >= 1)
    return {static_cast<int>(ensemble), static_cast<std::size_t>(number)};
  refuse("`--case` is " + asperity::quoted(text),
         "give the number of a case, such as 17, or 2.17 for the second ensemble");
}

// An empty text gives no value.
template <class T, class Parse>
CLI::Option* add_parsed(CLI::App& options, const std::string& name, std::optional<T>& value, Parse parse,
                        const std::string& help) {
  return options.add_option_function<std::string>(
      name,
      [&value, parse](const std::string& text) {
        if (!text.empty()) value = parse(text);
      },
      help);
}

}  // namespace

void add_seed(CLI::App& options, std::uint64_t& seed) {
  options.add_option("--seed", seed, "of math.random (default 1)")
      ->check(CLI::Validator(
          [](const std::string& text) {
            const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return whole && (text.size() < 19) ? std::string() : "a seed is a whole number from 0 to 10^18";
          },
          "WHOLE NUMBER"));
}

CLI::Option* add_script_options(CLI::App& options, RunCommand& run) {
  CLI::Option* script = options.add_option("script", run.script, "the Lua script")->required();
  add_seed(options, run.seed);
  add_seconds(options, "--limit-time", run.limit_time, "end the run after this long, e.g. 60s or \"2 min\"");
  options.add_option("arguments", run.arguments, "reach the script as ... and arg; put them after --");
  return script;
}

void add_knobs(CLI::App& options, GivenKnobs& knobs) {
  options
      .add_option_function<std::vector<std::string>>(
          "--knob",
          [&knobs](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) read_knob(knobs, text);
          },
          "NAME=VALUE: what a knob of the script (lab.knob) is set to, e.g. --knob pressure=\"50 MPa\"; may "
          "be given again")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void add_seconds(CLI::App& options, const std::string& name, std::optional<double>& seconds,
                 const std::string& help) {
  add_parsed(options, name, seconds, seconds_of, help);
}

void add_bytes(CLI::App& options, const std::string& name, std::optional<std::int64_t>& bytes,
               const std::string& limit, const std::string& help) {
  add_parsed(
      options, name, bytes, [limit](const std::string& text) { return bytes_of(text, limit); }, help);
}

void add_machine_options(CLI::App& options, int& threads, std::optional<std::int64_t>& memory) {
  options.add_option("--threads", threads, "threads to use (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  add_bytes(options, "--limit-memory", memory, "a memory limit", "most memory, e.g. 4G");
}

void add_run_options(CLI::App& options, RunCommand& run) {
  options.add_option("--out", run.out, "the run directory (default runs/<script>-<n>); must be new or empty");
  options.add_flag("--trace", run.trace, "print the calls that led to an error");
  add_machine_options(options, run.threads, run.limit_memory);
}

void add_trust(CLI::App& options, bool& trust) {
  options.add_flag("--trust", trust, "give the script the whole of Lua, and files anywhere");
}

void add_confinement(CLI::App& options, RunCommand& run) {
  options.add_flag("--confined", run.confined,
                   "for a script of somebody else's: it reads no file but those of --read, writes the run "
                   "directory and reaches no other file, process or network, by barriers of the operating "
                   "system; 10 min, half the machine's memory and 1 GiB on the disk unless told otherwise");
  options
      .add_option("--read", run.read,
                  "a folder that a confined script may read, such as its own; may be given again")
      ->type_name("DIR")
      ->allow_extra_args(false);
  options.add_option("--without-barriers", run.without_barriers,
                     "which barriers need not stand where the system cannot give them: files, processes, "
                     "network, programs, with commas between");
  add_bytes(options, "--limit-disk", run.limit_disk, "the limit of the disk",
            "most bytes in the directory of a confined run, e.g. 4G (default 1G)");
}

void check_confinement(const RunCommand& run) {
  if (run.confined) return;
  for (const auto& [option, given] : {std::pair("`--read`", !run.read.empty()),
                                      std::pair("`--without-barriers`", !run.without_barriers.empty()),
                                      std::pair("`--limit-disk`", run.limit_disk.has_value())})
    if (given) refuse(std::string(option) + " needs a confined run", "add --confined, or leave it out");
}

void add_store_options(CLI::App& options, RunCommand& run) {
  CLI::Option* resume =
      options.add_option("--resume", run.resume,
                         "go on with the run in this directory where it was cut off; its script, arguments "
                         "and seed are its own (a directory that is not there yet is begun)");
  resume->excludes(options.get_option("--out"));
  options
      .add_option("--reuse", run.reuse,
                  "take the results of heavy calls that are the same from this run; may be given again")
      ->allow_extra_args(false);  // the script may follow
  add_parsed(
      options, "--store-limit", run.store_limit,
      [](const std::string& text) { return text == "0" ? 0 : bytes_of(text, "the limit of the store"); },
      "most bytes of results to keep for this, e.g. 20G (default 8G); 0 keeps none");
  options.add_option(
      "--store", run.store,
      "keep results in this folder and find them there, instead of RUN/store; several runs, on several "
      "machines, may share it at the same time (no limit unless --store-limit is given)");
  CLI::Option* share = add_parsed(
      options, "--shard", run.shard, parse_shard,
      "i/n: compute the cases i, i+n, i+2n, ... of every ensemble and keep them in the folder given by "
      "--store; slurm: i and n are those of this task of a job array. The script goes on past an ensemble "
      "once all its cases are there, and else ends. A run without --shard puts all together");
  CLI::Option* one = add_parsed(
      options, "--case", run.one_case, parse_case,
      "compute case 17, or case 17 of the second ensemble (2.17), into the folder given by --store, and "
      "leave no run directory. Exit status: 0 it is stored, 1 it failed, 3 cases of an earlier ensemble are "
      "missing. `asperity cases` lists the numbers");
  CLI::Option* merge = options.add_flag("--merge-only", run.merge_only,
                                        "compute no case: take all from the folder given by --store, or end "
                                        "with exit status 3 and the list of the missing cases");
  for (CLI::Option* option : {share, one, merge})
    option->needs(options.get_option("--store"))->excludes(options.get_option("--trust"));
  for (CLI::Option* other :
       {share, merge, resume, options.get_option("--out"), options.get_option("--reuse")})
    one->excludes(other);
  merge->excludes(share);
}

Shard parse_shard(const std::string& text) {
  if (text == "slurm") return from_slurm();
  const std::size_t slash = text.find('/');
  const auto index = count_in(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : count_in(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *count < *index || *count > 1'000'000)
    refuse("`--shard` is " + asperity::quoted(text),
           "give i/n with i from 1 to n, as in --shard 2/3, or slurm");
  return {static_cast<int>(*index), static_cast<int>(*count)};
}

std::string read_script(const std::string& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem))
    refuse_bad_file(quoted(path) + " is a folder", "give the path of a Lua script");
  if (::access(path.c_str(), R_OK) != 0)
    refuse_bad_file("there is no script " + quoted(path) + " that can be read");
  return text_of_file(path);
}

}  // namespace asperity::cli
