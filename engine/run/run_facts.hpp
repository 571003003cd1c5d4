// SPDX-License-Identifier: GPL-3.0-or-later
// Facts for a manifest: machine, date, digests of files. They never enter a result.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity {

// "2025-01-31T12:00:00Z".
std::string utc_now();

// Processor, vector instructions, memory (bytes), system, C library and its rounding (program_identity.hpp),
// build; unknown facts are missing. Computed once: call before access to /proc ends.
Json machine_facts();

// Differences with possible effect on last digits: "another processor: X, here Y". Empty also for empty
// `then`.
std::vector<std::string> differing_machines(const Json& then, const Json& now);

// Includes gnuplot and the font.
Json machine_facts_of_pictures();

// Reads pieces of 1 MiB. Throws Error{bad_file}.
std::string file_digest(const std::filesystem::path& path);
std::string content_digest(std::string_view content);

}  // namespace asperity
