// SPDX-License-Identifier: GPL-3.0-or-later
// Options of several commands. The parser stores quantities as text; seconds_of and bytes_of read the text
// after parsing.
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

// The referenced variables must outlive the parsing.

void add_seed(CLI::App& options, std::uint64_t& seed);
// Script (required), seed, --limit-time and arguments. Returns the script's option.
CLI::Option* add_script_options(CLI::App& options, RunCommand& run, std::string& limit_time);
// Repeatable; read by knobs_of.
void add_knobs(CLI::App& options, std::vector<std::string>& knobs);
void add_machine_options(CLI::App& options, int& threads, std::string& memory);
// --out and the machine options.
void add_run_options(CLI::App& options, RunCommand& run, std::string& memory);
void add_trust(CLI::App& options, bool& trust);
// --confined and its options.
void add_confinement(CLI::App& options, RunCommand& run, std::string& limit_disk);

// Throws Error{bad_value} for a confined run's option in another run.
void check_confinement(const RunCommand& run);

// "60s", "2 min", or positive seconds; none for "". Throws Error{bad_value}.
std::optional<double> seconds_of(const std::string& text);
// "pressure=50 MPa" each. Throws Error{bad_value}.
GivenKnobs knobs_of(const std::vector<std::string>& texts);
// "4G", "512M", "64KiB", "1000000"; none for "". Throws Error{bad_value} naming the limit `what`.
std::optional<std::int64_t> bytes_of(const std::string& text, const std::string& what = "a memory limit");

}  // namespace asperity::cli
