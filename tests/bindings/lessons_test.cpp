// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/lessons.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::lua::lessons_test {
namespace {

constexpr std::string_view script =
    "-- A title\n"
    "-- Question: Why?\n"
    "-- Predict: How much,\n"
    "--   and when?\n"
    "-- Minutes: 15\n"
    "--\n"
    "-- First paragraph,\n"
    "-- of two lines.\n"
    "--\n"
    "-- Second.\n"
    "\n"
    "-- SPDX-License-Identifier: GPL-3.0-or-later\n"
    "local lab = require \"asperity\"\n";

std::string message(std::string_view stem, std::string text) {
  return test::error_of([&] { read_lesson(stem, text); });
}

std::string without(const std::string& part) {
  std::string text(script);
  return text.erase(text.find(part), part.size());
}

TEST(Lesson, TellsWhatItsOpeningCommentSays) {
  const Lesson lesson = read_lesson("07_one", script);
  EXPECT_EQ(lesson.number, 7);
  EXPECT_EQ(lesson.name, "one");
  EXPECT_EQ(lesson.file, "07_one.lua");
  EXPECT_EQ(lesson.title, "A title");
  EXPECT_EQ(lesson.question, "Why?");
  EXPECT_EQ(lesson.predict, "How much, and when?");
  EXPECT_EQ(lesson.minutes, 15);
  EXPECT_EQ(lesson.explanation, "First paragraph,\nof two lines.\n\nSecond.\n");
  EXPECT_EQ(lesson.text, "Question: Why?\n\nPredict: How much, and when?\n\n" + lesson.explanation);
  EXPECT_EQ(lesson.script, script);
}

TEST(Lesson, WithoutAPartIsAnError) {
  EXPECT_EQ(message("07_one", std::string(script)), "");
  EXPECT_EQ(message("one", std::string(script)),
            "the lesson `one` has no number; call its file such as 06_tilt.lua");
  EXPECT_EQ(message("07", std::string(script)),
            "the lesson `07` has no number; call its file such as 06_tilt.lua");
  EXPECT_EQ(
      message("07_one", ""),
      "the lesson `07_one.lua` lacks a title in its first line; its opening comment says what it is about");
  EXPECT_NE(message("07_one", without("-- Question: Why?\n")).find("lacks a line `-- Question: ...`"),
            std::string::npos);
  EXPECT_NE(message("07_one", without("-- Predict: How much,\n--   and when?\n")).find("`-- Predict: ...`"),
            std::string::npos);
  EXPECT_NE(message("07_one", without("15")).find("`-- Minutes: N`"), std::string::npos);
  EXPECT_NE(message("07_one", without("-- First paragraph,\n-- of two lines.\n--\n-- Second.\n"))
                .find("an explanation after an empty comment line"),
            std::string::npos);
}

TEST(Lessons, AreTenInOrder) {
  ASSERT_EQ(lessons().size(), 10u);
  int number = 0;
  for (const Lesson& lesson : lessons()) {
    EXPECT_EQ(lesson.number, ++number) << lesson.file;
    EXPECT_NE(lesson.script.find("SPDX-License-Identifier"), std::string_view::npos) << lesson.file;
    EXPECT_NE(lesson.script.find("my_guess"), std::string_view::npos) << lesson.file;
    EXPECT_NE(lesson.script.find(":expect("), std::string_view::npos) << lesson.file;
    EXPECT_NE(lesson.script.find(":chart{"), std::string_view::npos) << lesson.file;
  }
}

TEST(Lessons, AreFoundByNameNumberAndFile) {
  for (const char* called : {"tilt", "6", "06_tilt", "06_tilt.lua"})
    EXPECT_EQ(find_lesson(called).name, "tilt") << called;
  EXPECT_THROW(find_lesson(""), Error);
  EXPECT_THROW(find_lesson("0"), Error);
  EXPECT_THROW(find_lesson("06"), Error);
  try {
    find_lesson("acuracy");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unknown_name);
    EXPECT_NE(std::string(error.what()).find("did you mean `accuracy`?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace asperity::lua::lessons_test
