// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several commands share, each worded and checked in one place: the script and its seed, the
// machine, the run directory, barriers. Where a value is a quantity, the parser keeps its text, and
// seconds_of or bytes_of reads the text once the whole command line is known to parse.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/commands/run_command.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace asperity::cli {

// The parser writes what it reads into the references given here, which outlive the parsing.

void add_seed(CLI::App& options, std::uint64_t& seed);
// The script, which is required, its seed, --limit-time and its arguments. Returns the option of the script.
CLI::Option* add_script_options(CLI::App& options, RunCommand& run, std::string& limit_time);
// --knob, which may be given again; knobs_of reads it.
void add_knobs(CLI::App& options, std::vector<std::string>& knobs);
// --threads and --limit-memory.
void add_machine_options(CLI::App& options, int& threads, std::string& memory);
// --out and those of the machine.
void add_run_options(CLI::App& options, RunCommand& run, std::string& memory);
void add_trust(CLI::App& options, bool& trust);
// --confined and what belongs to a confined run alone.
void add_confinement(CLI::App& options, RunCommand& run, std::string& limit_disk);

// Throws Error{bad_value} where an option of a confined run was given and the run is not confined.
void check_confinement(const RunCommand& run);

// "60s", "2 min", or a number of seconds, above zero; none of "". Throws Error{bad_value}.
std::optional<double> seconds_of(const std::string& text);
// "pressure=50 MPa" each. Throws Error{bad_value}.
GivenKnobs knobs_of(const std::vector<std::string>& texts);
// "4G", "512M", "64KiB", "1000000"; none of "". Throws Error{bad_value} in which `what` names the limit.
std::optional<std::int64_t> bytes_of(const std::string& text, const std::string& what = "a memory limit");

}  // namespace asperity::cli
