// SPDX-License-Identifier: GPL-3.0-or-later
// Facts for a manifest that never enter a result: machine, date, digests of files.
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
// build; unknown facts are missing. Determined once: call before access to /proc ends.
Json machine_facts();

// Differences that may change last digits: "another processor: X, here Y". Empty also if `then` has no facts.
std::vector<std::string> differing_machines(const Json& then, const Json& now);

// Also gnuplot and the font of pictures.
Json machine_facts_of_pictures();

// Reads pieces of 1 MiB. Throws Error{bad_file}.
std::string file_digest(const std::filesystem::path& path);
std::string content_digest(std::string_view content);

}  // namespace asperity
