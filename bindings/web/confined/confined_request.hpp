// SPDX-License-Identifier: GPL-3.0-or-later
// The request to a confined process on standard input, as JSON. Texts are bytes of any encoding: a byte is
// the character of this number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/web/sandbox/confinement.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

inline constexpr int events_descriptor = 3, drawing_descriptor = 4, lock_descriptor = 5;
// For a picture's data, and for the picture.
inline constexpr std::size_t most_picture_bytes = std::size_t{64} << 20;

enum class Work { run, check, draw, probe, command, live };

// `run` has both options; the replay's own `run` stays behind.
struct CarriedCommand {
  cli::RunCommand run;
  std::optional<cli::ReplayCommand> replay{};
};

// The name of a page's script, in errors and records.
inline constexpr const char* page_script = "script.lua";

struct ConfinedRequest {
  Work work = Work::run;
  Confinement confinement;
  std::string script{};
  std::int64_t seed = 1;
  double seconds = 60;  // time limit of the script
  int threads = 1;
  bool views = false;
  GivenKnobs knobs{};
  std::vector<std::string> barriers{};  // required; names as in confine()
  std::optional<CarriedCommand> command{};
  int lock = -1;  // of the run directory; -1: none
};

// The run or the check of a script of the page, in the working directory.
cli::RunCommand page_command(const ConfinedRequest& request, cli::RunObserver& observer);

Json to_json(const ConfinedRequest& request);
// Throws Error{bad_file}.
ConfinedRequest confined_request(const Json& json);

// Throws Error{bad_file} for a character beyond U+00FF.
std::string bytes_of(std::string_view characters);

}  // namespace asperity::web
