// SPDX-License-Identifier: GPL-3.0-or-later
// What `asperity serve` makes of its options and of the machine: people, limits, and where runs are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/web/api/access.hpp"
#include "bindings/web/runs/run_queue.hpp"
#include "bindings/web/serve_command.hpp"

namespace asperity::web {

// The one who started it, and the students of a room. Throws Error{bad_value} or Error{bad_file}.
std::vector<Person> people_of(const ServeCommand& command);
// The queue's bounds; folder and barriers are left empty.
QueueSetup queue_of(const ServeCommand& command);
// runs/serve-<n>, or the folder that was named, which must be new or empty. Throws Error.
std::filesystem::path session_folder(const ServeCommand& command);
// What a browser may call the server.
std::vector<std::string> hosts_of(const ServeCommand& command, int port);
// The address as it stands in a URL.
std::string shown_address(const ServeCommand& command);

}  // namespace asperity::web
