// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/commands/shared_options.hpp"

#include <CLI/CLI.hpp>

#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

void add_seed(CLI::App& options, std::uint64_t& seed) {
  options.add_option("--seed", seed, "of math.random (default 1)")
      ->check(CLI::Validator(
          [](const std::string& text) {
            const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return whole && (text.size() < 19) ? std::string() : "a seed is a whole number from 0 to 10^18";
          },
          "WHOLE NUMBER"));
}

CLI::Option* add_script_options(CLI::App& options, RunCommand& run, std::string& limit_time) {
  CLI::Option* script = options.add_option("script", run.script, "the Lua script")->required();
  add_seed(options, run.seed);
  options.add_option("--limit-time", limit_time, "end the run after this long, e.g. 60s or \"2 min\"");
  options.add_option("arguments", run.arguments, "reach the script as ... and arg; put them after --");
  return script;
}

void add_knobs(CLI::App& options, std::vector<std::string>& knobs) {
  options
      .add_option(
          "--knob", knobs,
          "NAME=VALUE: what a knob of the script (lab.knob) is set to, e.g. --knob pressure=\"50 MPa\"; "
          "may be given again")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void add_machine_options(CLI::App& options, int& threads, std::string& memory) {
  options.add_option("--threads", threads, "threads to use (default: one per processor)")
      ->check(CLI::Range(1, 4096));
  options.add_option("--limit-memory", memory, "most memory, e.g. 4G");
}

void add_run_options(CLI::App& options, RunCommand& run, std::string& memory) {
  options.add_option("--out", run.out, "the run directory (default runs/<script>-<n>); must be new or empty");
  add_machine_options(options, run.threads, memory);
}

void add_trust(CLI::App& options, bool& trust) {
  options.add_flag("--trust", trust, "give the script the whole of Lua, and files anywhere");
}

void add_confinement(CLI::App& options, RunCommand& run, std::string& limit_disk) {
  options.add_flag(
      "--confined", run.confined,
      "for a script of somebody else's: it reads no file but those of --read, writes the run directory and "
      "reaches no other file, process or network, by barriers of the operating system; 10 min, half the "
      "machine's memory and 1 GiB on the disk unless told otherwise");
  options
      .add_option("--read", run.read,
                  "a folder that a confined script may read, such as its own; may be given again")
      ->type_name("DIR")
      ->allow_extra_args(false);
  options.add_option(
      "--without-barriers", run.without_barriers,
      "which barriers need not stand where the system cannot give them: files, processes, network, "
      "programs, with commas between");
  options.add_option("--limit-disk", limit_disk,
                     "most bytes in the directory of a confined run, e.g. 4G (default 1G)");
}

void check_confinement(const RunCommand& run) {
  if (run.confined) return;
  for (const auto& [option, given] : {std::pair("`--read`", !run.read.empty()),
                                      std::pair("`--without-barriers`", !run.without_barriers.empty()),
                                      std::pair("`--limit-disk`", run.limit_disk.has_value())})
    if (given)
      throw Error(ErrorCode::bad_value, std::string(option) + " is of a confined run, and this one is not",
                  "add --confined, or leave it out");
}

std::optional<double> seconds_of(const std::string& text) {
  if (text.empty()) return {};
  try {
    const Quantity q = parse_quantity(text);
    if ((q.dimension == dimension::time || q.dimension == dimension::number) && q.value > 0) return q.value;
  } catch (const Error&) {
  }
  throw Error(ErrorCode::bad_value, "a time limit is " + asperity::quoted(text),
              "give a time such as 60s or \"2 min\"");
}

GivenKnobs knobs_of(const std::vector<std::string>& texts) {
  GivenKnobs knobs;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error(ErrorCode::bad_value, "`--knob` is " + asperity::quoted(text),
                  "give a name and its value, as in --knob pressure=\"50 MPa\"");
    try {
      give_knob(knobs, text.substr(0, equals), text.substr(equals + 1));
    } catch (const Error& error) {
      throw Error(error.code(), "`--knob`: " + error.sentence(), error.hint());
    }
  }
  return knobs;
}

std::optional<std::int64_t> bytes_of(const std::string& text, const std::string& what) {
  if (text.empty()) return {};
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
    throw Error(ErrorCode::bad_value, what + " is " + asperity::quoted(text),
                "give bytes such as 512M or 4G");
  return static_cast<std::int64_t>(value * factor);
}

}  // namespace asperity::cli
