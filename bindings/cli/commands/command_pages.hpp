// SPDX-License-Identifier: GPL-3.0-or-later
// Pages made from the command line as the program reads it, so that they cannot say anything else: the manual
// page asperity(1), and what a shell completes.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace asperity::cli {

// In the macros of man(7).
std::string manual_page(const CLI::App& app, const std::string& version);

// For bash: commands, the options of each, scripts, run directories, and these lessons.
std::string bash_completion(const CLI::App& app, const std::vector<std::string>& lessons);

}  // namespace asperity::cli
