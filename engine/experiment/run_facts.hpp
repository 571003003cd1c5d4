// SPDX-License-Identifier: GPL-3.0-or-later
// Facts about the run's surroundings that enter a manifest but never a result: the machine, the date,
// the digest of a file.
#pragma once

#include <filesystem>
#include <string>

#include "engine/experiment/json.hpp"

namespace asperity {

// "2025-01-31T12:00:00Z".
std::string utc_now();

// Processor, number of processors, memory in bytes, operating system. What cannot be found is left out. Found
// out once: a process that will be shut off from /proc asks before.
Json machine_facts();

// Digest of a file's content, read in pieces of 1 MiB. Throws Error{bad_file}.
std::string file_digest(const std::filesystem::path& path);

}  // namespace asperity
