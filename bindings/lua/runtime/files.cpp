// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/files.hpp"

#include <filesystem>
#include <string_view>

#include "bindings/lua/registry/case_input.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity::lua {

std::string writable_path(const Call& call, const std::string& name) {
  const Session& session = call.session();
  if (session.is_case)
    throw Error(ErrorCode::not_permitted, "a case of an ensemble writes no files",
                "return what it found, and write after the loop");
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
  // The run's own files have the same name in every run.
  const std::string own = session.run->own_name(path);
  if (session.run->note_input(own.empty() ? path : own, bytes, file_digest(path)) && own.empty())
    session.monitor().inform("\"" + plain_text(path) +
                             "\" is not what it was when the run that is taken up had read it");
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

std::string format_names() {
  std::vector<std::string> names;
  for (const Format* format : formats()) names.push_back("\"" + std::string(format->name) + "\"");
  return joined(names);
}

std::string names_of_formats_with_channels() {
  std::vector<std::string> names;
  for (const Format* format : formats())
    if (format->read_channel != nullptr) names.push_back("\"" + std::string(format->name) + "\"");
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

}  // namespace asperity::lua
