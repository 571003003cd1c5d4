// SPDX-License-Identifier: GPL-3.0-or-later
// People, limits and folder of `asperity serve`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/web/api/access.hpp"
#include "bindings/web/runs/run_queue.hpp"
#include "bindings/web/serve_command.hpp"

namespace asperity::web {

// Owner and students. Throws Error{bad_value} or Error{bad_file}.
std::vector<Person> people_of(const ServeCommand& command);
// Without folder and barriers.
QueueSetup queue_of(const ServeCommand& command);
// runs/serve-<n>, or the named new or empty folder. Throws Error.
std::filesystem::path session_folder(const ServeCommand& command);
std::vector<std::string> hosts_of(const ServeCommand& command, int port);
// In URL form.
std::string shown_address(const ServeCommand& command);

}  // namespace asperity::web
