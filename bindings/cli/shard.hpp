// SPDX-License-Identifier: GPL-3.0-or-later
// `--shard 2/3`, `--shard slurm` and `--case 17`: this process's share of ensemble cases.
#pragma once

#include <optional>
#include <string>

#include "engine/run/case_scheduler.hpp"

namespace asperity::cli {

std::optional<std::string> environment_variable(const char* name);

// "slurm" reads SLURM_ARRAY_TASK_ID, _MIN and _COUNT of a job array with consecutive numbers. Throws
// Error{bad_value}.
Shard parse_shard(const std::string& text);
// "17", or "2.17" of the second ensemble. Throws Error{bad_value}.
CaseNumber parse_case(const std::string& text);

}  // namespace asperity::cli
