// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/case_input.hpp"

#include <filesystem>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::lua {

std::string present_digest(const std::string& file) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem)) return {};
  try {
    return file_digest(file);
  } catch (const Error&) {
    return {};
  }
}

CaseInput input_of_case(const std::string& file) {
  std::error_code problem;
  CaseInput input{file, 0, present_digest(file)};
  if (!input.digest.empty())
    input.bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, problem));
  return input;
}

}  // namespace asperity::lua
