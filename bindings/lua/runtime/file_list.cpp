// SPDX-License-Identifier: GPL-3.0-or-later
// lab.files: the files of a folder whose names match a pattern.
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

namespace fs = std::filesystem;

bool has_wildcard(const std::string& text) { return text.find_first_of("*?") != std::string::npos; }

// * matches any characters, ? one character. O(name × pattern).
bool matches_pattern(std::string_view name, std::string_view pattern) {
  // On a mismatch, the last * takes one more character.
  std::size_t n = 0, p = 0, star = std::string_view::npos, from = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      from = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++n;
      ++p;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++from;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code problem;
  const fs::directory_iterator entries(folder, problem);
  if (problem)
    throw Error(ErrorCode::bad_file,
                "the folder " + file_name(folder.string()) + " cannot be read: " + problem.message(),
                "check the path and its spelling");
  for (const fs::directory_entry& entry : entries) {
    std::error_code ignored;
    if (entry.is_regular_file(ignored)) names.insert(entry.path().filename().string());
  }
  return names;
}

Values list_files(Call& call) {
  const std::string given = call.text(1, "pattern");
  const fs::path pattern(given);
  const std::string wanted = pattern.filename().string(), folder = pattern.parent_path().string();
  if (wanted.empty() || given.find('\0') != std::string::npos || has_wildcard(folder))
    throw Error(ErrorCode::bad_value, "`pattern` is \"" + plain_text(given) + "\"",
                "give one folder and a pattern of names in it, such as \"scans/*.x3p\"");
  std::set<std::string> names;
  std::error_code ignored;
  const fs::path place = folder.empty() ? fs::path(".") : fs::path(folder);
  const Session& session = call.session();
  // The run's own files are found under the script's names for them.
  const auto take_written = [&] {
    if (session.run == nullptr) return false;
    bool some = false;
    for (const std::string& file : session.run->written())
      if (const fs::path written = fs::path(file).lexically_normal();
          written.parent_path() == pattern.lexically_normal().parent_path() &&
          fs::is_regular_file(session.run->place_to_read(file), ignored)) {
        names.insert(written.filename().string());
        some = true;
      }
    return some;
  };
  if (const bool written = take_written(); !written || fs::is_directory(place, ignored))
    for (const std::string& name : files_in(place)) names.insert(name);
  List list;
  for (const std::string& name : names) {
    if (!matches_pattern(name, wanted) || (name.front() == '.' && wanted.front() != '.')) continue;
    list.items.emplace_back(folder.empty() ? name : (pattern.parent_path() / name).string());
  }
  if (list.items.empty())
    session.monitor().warn("no file matches \"" + plain_text(given) + "\" among " +
                           std::to_string(names.size()) + " of its folder");
  return {std::move(list)};
}

}  // namespace

Function files_function() {
  return {.name = "files",
          .body = list_files,
          .sentence =
              "The files of a folder whose names match a pattern, in the order of their names, as "
              "lab.surface.read and the other readers take them: * stands for any characters, ? for one. "
              "Which files there were is recorded, and a replay tells where others are there.",
          .parameters = {{"pattern", "string", "a folder and a pattern of names in it"}},
          .returns = "string[]",
          .example = "for _, file in ipairs(lab.files \"*.csv\") do print(file) end",
          .heavy = true};
}

}  // namespace asperity::lua
