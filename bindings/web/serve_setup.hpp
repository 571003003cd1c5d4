// SPDX-License-Identifier: GPL-3.0-or-later
// From the options of `asperity serve` and the machine: people, limits, and the folder of the runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/web/api/access.hpp"
#include "bindings/web/runs/run_queue.hpp"
#include "bindings/web/serve_command.hpp"

namespace asperity::web {

// The owner of the server and the students. Throws Error{bad_value} or Error{bad_file}.
std::vector<Person> people_of(const ServeCommand& command);
// Bounds of the queue; folder and barriers stay empty.
QueueSetup queue_of(const ServeCommand& command);
// runs/serve-<n>, or the named folder, which must be new or empty. Throws Error.
std::filesystem::path session_folder(const ServeCommand& command);
// The accepted Host values.
std::vector<std::string> hosts_of(const ServeCommand& command, int port);
// The address in URL form.
std::string shown_address(const ServeCommand& command);

}  // namespace asperity::web
