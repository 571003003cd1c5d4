// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/editor/lessons.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

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
  EXPECT_EQ(lesson.script, script);
}

constexpr std::string_view markdown =
    "# A title\n"
    "\n"
    "**Question:** Why?\n"
    "\n"
    "Predict: How much,\n"
    "and when?\n"
    "\n"
    "**Minutes:** 15\n"
    "\n"
    "First paragraph,\n"
    "of two lines.\n"
    "\n"
    "Second.\n"
    "\n"
    "```lua\n"
    "local lab = require \"asperity\"\n"
    "\n"
    "print(lab)\n"
    "```\n"
    "\n"
    "Notes: for the teacher.\n";

TEST(Lesson, InMarkdownHasTheSameParts) {
  const Lesson lesson = read_lesson("07_one", script_of_markdown("07_one.md", markdown));
  EXPECT_EQ(lesson.title, "A title");
  EXPECT_EQ(lesson.question, "Why?");
  EXPECT_EQ(lesson.predict, "How much, and when?");
  EXPECT_EQ(lesson.minutes, 15);
  EXPECT_EQ(lesson.explanation, "First paragraph,\nof two lines.\n\nSecond.\n");
  EXPECT_EQ(lesson.notes, "for the teacher.");
  EXPECT_TRUE(lesson.script.ends_with("\n\nlocal lab = require \"asperity\"\n\nprint(lab)\n"))
      << lesson.script;
  EXPECT_EQ(lesson.script.find("Notes"), std::string::npos);
}

TEST(Lesson, InMarkdownHasOneScript) {
  const auto refusal = [](std::string_view text) {
    return test::error_of([&] { script_of_markdown("07_one.md", text); });
  };
  EXPECT_EQ(refusal("# A title\n"),
            "`07_one.md` has 0 blocks ```lua; a lesson in Markdown has its script in one block ```lua");
  EXPECT_EQ(
      refusal("# A title\n```lua\nprint(1)\n"),
      "`07_one.md` has a block ```lua without its end ```; a lesson in Markdown has its script in one block "
      "```lua");
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

TEST(Lesson, KeepsNotesOutOfItsScript) {
  const std::string head = "-- A title\n-- Question: Why?\n-- Predict: When?\n-- Minutes: 15\n";
  const std::string code = "\n-- Notes: of the code\nprint(1)\n";
  const std::string told = head + "--\n-- Text.\n";
  for (const std::string& noted : {head + "-- notes: Secret,\n--   twice.\n--\n-- Text.\n" + code,
                                   told + "-- Notes:\n-- Secret,\n-- twice.\n" + code}) {
    const Lesson lesson = read_lesson("07_one", noted);
    EXPECT_EQ(lesson.script, told + code);
    EXPECT_EQ(lesson.explanation, "Text.\n");
    EXPECT_TRUE(lesson.notes.starts_with("Secret,")) << lesson.notes;
    EXPECT_TRUE(lesson.notes.ends_with("twice.")) << lesson.notes;
    EXPECT_FALSE(lesson.hides_code);
  }
}

TEST(Lesson, HidesItsCode) {
  const auto with = [](const std::string& code) {
    std::string text(script);
    return text.insert(text.find("-- Minutes"), "-- Code: " + code + "\n");
  };
  EXPECT_TRUE(read_lesson("07_one", with("hidden")).hides_code);
  EXPECT_EQ(message("07_one", with("gone")),
            "the lesson `07_one.lua` has `Code: gone`; say `Code: hidden`, or leave the line out");
}

TEST(Lesson, WithAMistakeOfGrammarNamesItsLine) {
  EXPECT_EQ(message("07_one", std::string(script) + "local = 1\n\n"),
            "07_one.lua:14: <name> expected near '='; `asperity check` explains it");
}

TEST(LessonTexts, AreThePartsOfAFile) {
  const LessonTexts texts = read_lesson_texts(
      "de/07_one.txt",
      "Ein Titel\r\nQuestion: Warum,\n  und wann?\n\nText.\n\nReason:\nWarum: {1}.\n\nMehr.\n"
      "Answers:\nmore: mehr\nnote: in\n  Grad\nReplies:\nmore: Nein: nie.\n");
  EXPECT_EQ(texts.title, "Ein Titel");
  EXPECT_EQ(texts.question, "Warum, und wann?");
  EXPECT_EQ(texts.predict, "");
  EXPECT_EQ(texts.explanation, "Text.\n");
  EXPECT_EQ(texts.reason, "Warum: {1}.\n\nMehr.");
  EXPECT_EQ(texts.answers, (std::map<std::string, std::string>{{"more", "mehr"}, {"note", "in Grad"}}));
  EXPECT_EQ(texts.replies, (std::map<std::string, std::string>{{"more", "Nein: nie."}}));
  EXPECT_EQ(test::error_of([] { read_lesson_texts("de/07_one.txt", "T\n\nAnswers:\nmehr\n"); }),
            "`de/07_one.txt` has a line `mehr`; give an answer as `name: text`; indent its further lines");
}

// Each match of `pattern` (its first group, or the whole).
std::vector<std::string> all_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    found.push_back((*at)[at->size() - 1]);
  return found;
}

TEST(Lessons, HaveGermanTextsForEachPartOfTheirScripts) {
  for (const Lesson& lesson : lessons()) {
    ASSERT_TRUE(lesson.languages.contains("de")) << lesson.file;
    const LessonTexts& german = lesson.languages.at("de");
    for (const std::string& text :
         {german.title, german.question, german.predict, german.explanation, german.reason})
      EXPECT_NE(text, "") << lesson.file;
    // Names and remark of the guesses, options and quantities.
    const std::string& code = lesson.script;
    std::vector<std::string> names;
    for (const std::string& list : all_in(code, R"(local my_guess = \{([^}]*)\})"))
      for (const std::string& name : all_in(list, R"((\w+)=nil)")) names.push_back(name);
    for (const std::string& list : all_in(code, R"(guess\.choices\(my_guess([^)]*)\))"))
      for (const std::string& option : all_in(list, R"x("([^"]*)")x")) names.push_back(option);
    for (const std::string& of : all_in(code, R"x( of="([^"]*)"(?! \.\.))x")) names.push_back(of);
    if (!all_in(code, R"(local my_guess = [^\n]*-- )").empty()) names.emplace_back("note");
    for (const std::string& name : names)
      EXPECT_TRUE(german.answers.contains(name)) << lesson.file << ": " << name;
    // {1} … {n} for the n values of the reason.
    std::size_t values = 0;
    for (const std::string& reason : all_in(code, R"(prose"?\(?\[\[([^\]]*)\]\])"))
      values += all_in(reason, R"(%[-+#0]*\d*(\.\d+)?[a-z])").size();
    std::set<std::string> used, expected;
    for (const std::string& place : all_in(german.reason, R"(\{(\d+)\})")) used.insert(place);
    for (std::size_t k = 1; k <= values; ++k) expected.insert(std::to_string(k));
    EXPECT_EQ(used, expected) << lesson.file;
  }
}

TEST(Lessons, AreTenInOrder) {
  ASSERT_EQ(lessons().size(), 10u);
  int number = 0;
  for (const Lesson& lesson : lessons()) {
    EXPECT_EQ(lesson.number, ++number) << lesson.file;
    EXPECT_NE(lesson.script.find("SPDX-License-Identifier"), std::string::npos) << lesson.file;
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
