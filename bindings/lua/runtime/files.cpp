// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/files.hpp"

#include <fnmatch.h>

#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity::lua {

std::string writable_path(const Call& call, const std::string& name) {
  const Session& session = call.session();
  if (session.is_case)
    throw Error(ErrorCode::not_permitted, "a case of an ensemble writes no files",
                "return its results, and write after the loop");
  return session.run == nullptr ? name : session.run->path_for(name).string();
}

RunDirectory& run_of(const Call& call, const char* does, const char* instead) {
  const Session& session = call.session();
  if (session.is_case || session.run == nullptr)
    throw Error(ErrorCode::not_permitted, std::string("a case of an ensemble ") + does, instead);
  return *session.run;
}

std::string readable_path(const Call& call, const std::string& name) {
  const Session& session = call.session();
  return session.run == nullptr ? name : session.run->place_to_read(name).string();
}

void warn_of(const Call& call, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) call.session().monitor().warn(warning);
}

void note_input(const Call& call, const std::string& path) {
  const Session& session = call.session();
  std::error_code problem;
  if (session.notes != nullptr) session.notes->inputs.push_back(input_of_case(path));
  if (session.run == nullptr || session.is_case || !std::filesystem::is_regular_file(path, problem)) return;
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(path, problem));
  // With the same name in every run.
  const std::string own = session.run->own_name(path);
  if (session.run->note_input(own.empty() ? path : own, bytes, file_digest(path)) && own.empty())
    session.monitor().inform("\"" + plain_text(path) + "\" has changed since the resumed run read it");
}

std::optional<double> read_unit(const Argument& value, const OptionInfo& info, Problems& problems) {
  const bool named = value.is_text() && !value.text().empty() &&
                     std::string_view("+-.0123456789").find(value.text()[0]) == std::string_view::npos;
  if (!named) return detail::read_quantity(value, info, above(0), problems);
  try {
    const Quantity unit = parse_unit(value.text());
    if (unit.dimension == dimension::length) return unit.value;
    problems.push_back(quoted(info.name) + " is \"" + std::string(value.text().substr(0, 40)) +
                       "\", which is " + describe(unit.dimension) + "; give a length, e.g. \"um\"");
  } catch (const Error& error) {
    problems.push_back(quoted(info.name) + ": " + error.what());
  }
  return {};
}

std::string format_names(bool with_channels) {
  std::vector<std::string> names;
  for (const Format* format : formats())
    if (!with_channels || format->read_channel != nullptr)
      names.push_back("\"" + std::string(format->name) + "\"");
  return joined(names);
}

void read_fill(const Argument& value, const OptionInfo& info, HoleFill& fill, Problems& problems) {
  if (value.is_text() && value.text() == "interpolate") {
    fill = HoleFill::interpolate();
    return;
  }
  OptionInfo length = info;
  length.dimension = dimension::length;
  if (!value.is_text() && !value.is_number())
    return detail::wrong_type(value, info, "\"interpolate\" or a height such as \"0 um\"", problems);
  if (auto height = detail::read_quantity(value, length, any(), problems)) fill = HoleFill::with(*height);
}

namespace {

namespace fs = std::filesystem;

bool has_wildcard(const std::string& text) { return text.find_first_of("*?") != std::string::npos; }

// * matches any characters, ? one character.
bool matches_pattern(const std::string& name, const std::string& pattern) {
  std::string plain;
  for (const char c : pattern) plain += c == '[' ? std::string("[[]") : std::string(1, c);
  return ::fnmatch(plain.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code problem;
  const fs::directory_iterator entries(folder, problem);
  if (problem)
    refuse_bad_file("the folder " + file_name(folder.string()) + " cannot be read: " + problem.message(),
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
    refuse("`pattern` is \"" + plain_text(given) + "\"",
           "give one folder and a pattern of names in it, such as \"scans/*.x3p\"");
  std::set<std::string> names;
  std::error_code ignored;
  const fs::path place = folder.empty() ? fs::path(".") : fs::path(folder);
  const Session& session = call.session();
  // By the script's own names.
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
              "The files of a folder whose names match a pattern, in the order of their names, for "
              "lab.surface.read and the other readers: * matches any characters, ? matches one. The list "
              "is recorded, and a replay reports a different list.",
          .parameters = {{"pattern", "string", "a folder and a pattern of names in it"}},
          .returns = "string[]",
          .example = "for _, file in ipairs(lab.files \"*.csv\") do print(file) end",
          .heavy = true};
}

}  // namespace asperity::lua
