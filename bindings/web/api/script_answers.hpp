// SPDX-License-Identifier: GPL-3.0-or-later
// JSON answers about scripts and lessons, for the server and for WebAssembly.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/lessons.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// From the events of a check: {marks: [{line, severity, message}], checked_to?, knobs?, charts?}. Without
// `marks` if the check did not come to an end.
Json check_answer(const std::string& events);
// A mark on the first line.
Json note(const std::string& message);

// {from, candidates: [{text, kind, detail, help}]}, in UTF-16 units.
Json completion_of(const std::string& text, std::size_t unit);

// Convert UTF-16 units (browser) and UTF-8 bytes. byte_of_unit: first byte of the character, or the end.
std::size_t byte_of_unit(std::string_view text, std::size_t unit);
std::size_t unit_of_byte(std::string_view text, std::size_t byte);

// [{name, number, title, question, minutes, languages, problem?}]; lessons with a problem for the teacher
// only.
Json lesson_entries(const std::vector<lua::Lesson>& lessons, bool for_teacher);
// With texts and script; the notes for the teacher only.
Json lesson_answer(const lua::Lesson& lesson, bool for_teacher);

}  // namespace asperity::web
