// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity help`, `asperity materials` and `asperity version`.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "bindings/cli/commands/command.hpp"
#include "bindings/cli/exit_status.hpp"
#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/editor/lessons.hpp"
#include "bindings/lua/runtime/version.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/material.hpp"

namespace asperity::cli {

namespace {

struct HelpRequest {
  std::string topic;  // of the language; "": the overview
  bool reference = false, types = false, manual = false, completion = false;
};

// `program`: the parser, for manual page and completion.
std::string help_page(const HelpRequest& asked, const CLI::App& program, std::string (*overview)()) {
  if (asked.manual) return manual_page(program, lua::version_text());
  if (asked.completion) {
    std::vector<std::string> names;
    for (const lua::Lesson& known : lua::lessons()) names.push_back(known.name);
    return bash_completion(program, names);
  }
  if (asked.reference) return lua::reference_page();
  if (asked.types) return lua::editor_types();
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == asked.topic) return command->help(program.get_name());
  if (!asked.topic.empty()) return lua::help_text(asked.topic);
  return overview() + "\nEach command explains itself with --help.\n\n" + lua::help_text("");
}

int print_help(const HelpRequest& asked, const CLI::App& program, std::string (*overview)()) {
  try {
    std::fputs(help_page(asked, program, overview).c_str(), stdout);
  } catch (const Error& error) {
    return refused(error);
  }
  return done;
}

CommandReader declare_help(CLI::App& options, std::string (*overview)()) {
  const auto asked = std::make_shared<HelpRequest>();
  options.add_option("topic", asked->topic, "e.g. lab.surface, sine, State.area; or a command");
  options.add_flag("--reference", asked->reference, "the whole reference as Markdown");
  options.add_flag("--types", asked->types, "the types of the language for editors (LuaCATS)");
  options.add_flag("--manual", asked->manual, "this program's manual page");
  options.add_flag("--completion", asked->completion, "what bash completes on its command line");
  return [asked, overview, &options]() -> CommandWork {
    return [asked, overview, &options] { return print_help(*asked, *options.get_parent(), overview); };
  };
}

int print_materials() {
  std::printf("%-9s %-10s %-6s %-10s %-11s %s\n", "name", "E", "nu", "hardness", "density", "source");
  for (const Material& m : named_materials()) {
    auto shown = [](const std::optional<double>& value, Dimension dimension) {
      return value ? format_quantity(*value, dimension) : std::string("-");
    };
    std::printf(
        "%-9s %-10s %-6s %-10s %-11s %s\n", m.name.c_str(), shown(m.young, dimension::pressure).c_str(),
        m.poisson ? format_short(*m.poisson).c_str() : "-", shown(m.hardness, dimension::pressure).c_str(),
        m.density ? (format_short(*m.density) + " kg/m3").c_str() : "-", m.source.c_str());
  }
  return done;
}

int print_versions_of_program() {
  for (const auto& [name, version] : lua::version_facts())
    std::printf("%-9s %s\n", name.c_str(), version.c_str());
  return done;
}

}  // namespace

Command help_command(std::string (*overview)()) {
  return {.name = "help",
          .sentence = "explain the language: a module, a function, a value",
          .overview = "asperity help [TOPIC]                          explain the language\n",
          .declare = [overview](CLI::App& options) { return declare_help(options, overview); }};
}

Command materials_command() {
  return {.name = "materials",
          .sentence = "list the materials known by name",
          .overview = "asperity materials                             list the materials known by name\n",
          .declare = [](CLI::App&) -> CommandReader { return [] { return print_materials; }; }};
}

Command version_command() {
  return {
      .name = "version",
      .sentence = "show what this program is and was built with",
      .overview = "asperity version                               show what this program was built with\n",
      .declare = [](CLI::App&) -> CommandReader { return [] { return print_versions_of_program; }; }};
}

}  // namespace asperity::cli
