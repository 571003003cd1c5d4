// SPDX-License-Identifier: GPL-3.0-or-later
// A command for a confined process as JSON. Texts are bytes of any encoding; each byte becomes the character
// of this number.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bindings/cli/commands/replay_command.hpp"
#include "bindings/cli/commands/run_command.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

std::string characters_of(std::string_view bytes);
// Throws Error{bad_file} for a character beyond U+00FF.
std::string bytes_of(std::string_view characters);

struct CarriedCommand {
  cli::RunCommand run;
  std::optional<cli::ReplayCommand> replay;
};

// Lists of name and given value. command_json: `replay` may be null; its `run` is ignored. knobs_in throws
// Error{bad_file}.
Json knobs_json(const GivenKnobs& knobs);
GivenKnobs knobs_in(const Json& json, const char* name);
Json command_json(const cli::RunCommand& run, const cli::ReplayCommand* replay);
// Throws Error{bad_file}.
CarriedCommand command_of(const Json& json);

}  // namespace asperity::web
