// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/shard.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

namespace {

std::optional<long> whole_number(std::string_view text) {
  long value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

Shard from_slurm() {
  const auto read = [&](const char* name) -> long {
    const std::optional<std::string> text = environment_variable(name);
    if (!text)
      throw Error(
          ErrorCode::bad_value,
          "`--shard slurm` reads " + std::string(name) + ", which is not set: this is no task of a job array",
          "submit it with sbatch --array=1-N, or give --shard i/n");
    const std::optional<long> value = whole_number(*text);
    if (!value)
      throw Error(ErrorCode::bad_value,
                  std::string(name) + " is " + asperity::quoted(*text) + ", no whole number");
    return *value;
  };
  const long id = read("SLURM_ARRAY_TASK_ID"), count = read("SLURM_ARRAY_TASK_COUNT");
  const long first = environment_variable("SLURM_ARRAY_TASK_MIN") ? read("SLURM_ARRAY_TASK_MIN") : 1;
  const long last =
      environment_variable("SLURM_ARRAY_TASK_MAX") ? read("SLURM_ARRAY_TASK_MAX") : first + count - 1;
  const long index = id - first + 1;
  // A resubmitted task does not know the first array's size.
  const bool whole = (first == 0 || first == 1) && last - first + 1 == count;
  if (!whole || count > 1'000'000 || index < 1 || index > count)
    throw Error(ErrorCode::bad_value,
                "task " + std::to_string(id) + " of a job array of " + std::to_string(count) + " from " +
                    std::to_string(first) + " to " + std::to_string(last) + " is none of its shards",
                "number all tasks one after the other, as in sbatch --array=1-" +
                    std::to_string(std::max(count < 1 ? 4 : count, last)) +
                    "; for some of them alone, give --shard i/n");
  return {static_cast<int>(index), static_cast<int>(count)};
}

}  // namespace

std::optional<std::string> environment_variable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) return {};
  return std::string(value);
}

Shard parse_shard(const std::string& text) {
  if (text == "slurm") return from_slurm();
  const std::size_t slash = text.find('/');
  const auto index = whole_number(std::string_view(text).substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *count < *index || *count > 1'000'000)
    throw Error(ErrorCode::bad_value, "`--shard` is " + asperity::quoted(text),
                "give i/n with i from 1 to n, as in --shard 2/3, or slurm");
  return {static_cast<int>(*index), static_cast<int>(*count)};
}

CaseNumber parse_case(const std::string& text) {
  CaseNumber one;
  const std::size_t dot = text.find('.');
  const auto read = [&](std::string_view part, auto& value) {
    const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), value);
    return problem == std::errc() && end == part.data() + part.size() && value >= 1;
  };
  const std::string_view all(text);
  if ((dot == std::string::npos || read(all.substr(0, dot), one.ensemble)) &&
      read(dot == std::string::npos ? all : all.substr(dot + 1), one.number))
    return one;
  throw Error(ErrorCode::bad_value, "`--case` is " + asperity::quoted(text),
              "give the number of a case, such as 17, or 2.17 for the second ensemble");
}

}  // namespace asperity::cli
