// SPDX-License-Identifier: GPL-3.0-or-later
// Files of scripts: read from anywhere and listed among the run's inputs, written into the run directory.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::lua {

// Throws Error{not_permitted} outside the run directory and inside a case of an ensemble.
std::string writable_path(const Call& call, const std::string& name);
// Throws Error{not_permitted} inside a case: `does` completes the sentence ("draws no charts"), `instead` is
// the hint.
RunDirectory& run_of(const Call& call, const char* does, const char* instead);
// The run's file of this name, or the path as given.
std::string readable_path(const Call& call, const std::string& name);
void warn_of(const Call& call, const std::vector<std::string>& warnings);
void note_input(const Call& call, const std::string& path);
// Body of a reader: `read` of the file in argument 1 with options in argument 2.
template <const auto& block, auto read>
Values read_file(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const auto options = call.options(block, 2);
  // First: a file too large for memory is not read for its digest.
  const SourceFile file(path, call.session().monitor());
  note_input(call, path);
  return {object(read(file, options, call.session().monitor()))};
}

// "um" means "1 um".
std::optional<double> read_unit(const Argument& value, const OptionInfo& info, Problems& problems);
template <class O>
Option<O> length_of_one(StaticText name, std::optional<double> O::*member, StaticText sentence) {
  Option<O> option = quantity(name, member, dimension::length, above(0), sentence);
  option.read = [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
    if (const auto length = read_unit(value, info, problems)) options.*member = *length;
  };
  return option;
}
template <class O>
Option<O> unit_key(std::optional<double> O::*member) {
  return length_of_one("unit", member, "length of one height of the file, where it has no unit, e.g. \"um\"");
}
template <class O>
Option<O> unit_xy_key(std::optional<double> O::*member) {
  return length_of_one("unit_xy", member,
                       "length of one number of a position, in x y z points and in profiles of two columns "
                       "that do not say it, e.g. \"mm\"");
}
// "npy", "x3p" ...
std::string format_names(bool with_channels = false);
template <class O>
Option<O> format_key(std::string O::*member) {
  return text("format", member, "read as this format whatever the file looks like: " + format_names());
}
template <class O>
Option<O> channel_key(std::string O::*member) {
  return text("channel", member,
              "which of several maps in a file of " + format_names(true) + ", by its name or number");
}
void read_fill(const Argument& value, const OptionInfo& info, HoleFill& fill, Problems& problems);
template <class O>
Option<O> fill_key(HoleFill O::*member) {
  return custom("fill", "\"interpolate\"|a length",
                "value of unmeasured points; without it they stay missing", member, read_fill);
}

}  // namespace asperity::lua
