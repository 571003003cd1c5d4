// SPDX-License-Identifier: GPL-3.0-or-later
// Facts about the run's surroundings that enter a manifest but never a result: the machine, the date,
// the digest of a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity {

// "2025-01-31T12:00:00Z".
std::string utc_now();

// Processor and its vector instructions, number of processors, memory in bytes, operating system; C library
// and how its functions round here (program_identity.hpp), identity of the build. What cannot be found is
// left out. Found out once: a process that will be shut off from /proc asks before.
Json machine_facts();

// What differs between two machine_facts() that last digits may hang on, a line each: "another processor: X,
// here Y". Empty where nothing does, or where the first is of a version that noted none of it.
std::vector<std::string> differing_machines(const Json& then, const Json& now);

// The same with the gnuplot and the font that draw pictures here, as far as programs name them.
Json machine_facts_of_pictures();

// Digest of a file's content, read in pieces of 1 MiB. Throws Error{bad_file}.
std::string file_digest(const std::filesystem::path& path);
// The same of content that was read already.
std::string content_digest(std::string_view content);

}  // namespace asperity
