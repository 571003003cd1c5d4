// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/across_versions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/text.hpp"
#include "engine/run/journal.hpp"

namespace asperity {

namespace {

// Beside the greatest of its column a number that is nothing but rounding.
constexpr double rounding_of_column = 1e-12;

bool is_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// A digest of 32 hexadecimal digits at the front, standing alone.
bool begins_with_digest(std::string_view text) {
  constexpr std::size_t length = 32;
  const auto is_hexadecimal = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() >= length && std::all_of(text.begin(), text.begin() + length, is_hexadecimal) &&
         (text.size() == length || !is_word(text[length]));
}

// A word of a text: a number, a digest, or one character of all else.
struct Word {
  std::string_view text;
  std::optional<double> number{};
  bool is_digest = false;
};

std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    const bool stands_alone = at == 0 || !is_word(text[at - 1]);
    Word word{rest.substr(0, 1)};
    if (stands_alone && begins_with_digest(rest)) {
      word = {rest.substr(0, 32), {}, true};
    } else if (stands_alone && rest.front() >= '0' && rest.front() <= '9') {
      double number = 0;
      const auto [end, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
      if (problem == std::errc())
        word = {rest.substr(0, static_cast<std::size_t>(end - rest.data())), number, false};
    }
    at += word.text.size();
    words.push_back(word);
  }
  return words;
}

// Two values that differ: what of it is last digits, what are digests, and whether anything else is.
class Judgement {
 public:
  // `scale`: the greatest magnitude of the column they stand in.
  bool passes(const Json* one, const Json* other, double scale) {
    if (one == nullptr || other == nullptr) return one == other;
    if (*one == *other) return true;
    if (one->is_number() && other->is_number()) return numbers(one->number(), other->number(), scale);
    if (one->is_string() && other->is_string()) return texts(one->string(), other->string());
    if (one->is_list() && other->is_list()) {
      const Json::List &these = one->list(), &those = other->list();
      return std::equal(these.begin(), these.end(), those.begin(), those.end(),
                        [&](const Json& a, const Json& b) { return passes(&a, &b, scale); });
    }
    if (!one->is_object() || !other->is_object()) return false;
    const std::vector<DifferingMember> members = differing_members(one, other);
    return std::all_of(members.begin(), members.end(), [&](const DifferingMember& member) {
      return !(member.one == one && member.other == other) && passes(member.one, member.other, scale);
    });
  }

  std::int64_t last_digits = 0, digests = 0;

 private:
  bool numbers(double one, double other, double scale) {
    const double apart = std::abs(one - other);
    const double most = std::max(std::abs(one), std::abs(other));
    if (!(apart <= std::max(digits_kept * most, rounding_of_column * scale))) return false;
    ++last_digits;
    return true;
  }

  bool texts(std::string_view one, std::string_view other) {
    const std::vector<Word> these = words_of(one), those = words_of(other);
    return std::equal(
        these.begin(), these.end(), those.begin(), those.end(), [&](const Word& a, const Word& b) {
          if (a.text == b.text) return true;
          if (a.is_digest && b.is_digest) return ++digests > 0;
          return a.number && b.number && (*a.number == *b.number || numbers(*a.number, *b.number, 0));
        });
  }
};

std::string text_in(const Json& line, std::string_view name) {
  const Json* value = line.find(name);
  return value != nullptr && value->is_string() ? value->string() : std::string();
}

// What the script itself did: warnings come and go between versions.
std::vector<const Json*> steps_of(const std::vector<Json>& journal) {
  std::vector<const Json*> steps;
  for (const Json& line : journal)
    if (text_in(line, "event") != "warning") steps.push_back(&line);
  return steps;
}

// Members that are sentences, or numbers of lines.
bool is_left_out(const std::string& event, const DifferingMember& member) {
  if (member.path == "n" || member.path == "warnings") return true;
  if (event == "expect") return member.path == "sentence";
  if (event == "end") return member.path == "reason";
  // A key that this version knows and the other did not.
  return member.one == nullptr && member.path.starts_with("inputs.");
}

// The greatest magnitude of each column of each notebook.
using ColumnScales = std::map<std::pair<std::string, std::string>, double>;
ColumnScales greatest_of_columns(const std::vector<Json>& journal) {
  ColumnScales greatest;
  for (const Json& line : journal) {
    const Json* row = line.find("row");
    if (row == nullptr || !row->is_object()) continue;
    for (const auto& [name, value] : row->members()) {
      if (!value.is_number()) continue;
      double& column = greatest[{text_in(line, "notebook"), "row." + name}];
      column = std::max(column, std::abs(value.number()));
    }
  }
  return greatest;
}

class Comparison {
 public:
  Comparison(const RecordedRun& recorded, const RecordedRun& again, std::span<const LawMet> met)
      : recorded_(recorded), again_(again), met_(met), columns_(greatest_of_columns(recorded.journal)) {}

  AcrossVersions made() {
    compare_steps();
    if (recorded_.ended()) {
      compare_inputs();
      compare_outputs();
      compare_verdicts();
    }
    return std::move(result_);
  }

 private:
  void found(Difference difference, std::int64_t line) {
    std::vector<const ChangedLaw*> laws;
    for (const LawMet& law : met_)
      if (law.line <= line) laws.push_back(law.law);
    if (laws.empty())
      result_.differences.push_back(std::move(difference));
    else
      result_.explained.push_back({std::move(difference), std::move(laws)});
  }

  void compare_steps() {
    const std::vector<const Json*> then = steps_of(recorded_.journal), now = steps_of(again_.journal);
    std::size_t compared = std::max(then.size(), now.size());
    if (!recorded_.ended()) {
      compared = then.size();
      // What ended it is not what it found.
      if (compared > 0 && text_in(*then.back(), "event") == "end") --compared;
    }
    result_.lines = static_cast<std::int64_t>(std::min(compared, then.size()));
    for (std::size_t k = 0; k < compared; ++k)
      compare_step(k < then.size() ? then[k] : nullptr, k < now.size() ? now[k] : nullptr);
  }

  void compare_step(const Json* one, const Json* other) {
    if (one == nullptr || other == nullptr) {
      const Json& line = one != nullptr ? *one : *other;
      found(difference_of(where_of(line), {{"", one, other}}), other != nullptr ? number_of(*other) : last());
      return;
    }
    const std::string event = text_in(*one, "event"), notebook = text_in(*one, "notebook");
    std::vector<DifferingMember> beyond;
    for (const DifferingMember& member : differing_members(one, other)) {
      if (member.path.empty() || is_left_out(event, member)) continue;
      const auto column = columns_.find({notebook, member.path});
      Judgement judgement;
      // The script, its seed, and what kind of step it is: these are no results.
      const bool exact = event == "begin" || member.path == "event" || member.path == "function";
      if (!exact &&
          judgement.passes(member.one, member.other, column != columns_.end() ? column->second : 0)) {
        result_.in_last_digits += judgement.last_digits;
        result_.digests += judgement.digests;
      } else {
        beyond.push_back(member);
      }
    }
    if (!beyond.empty()) found(difference_of(where_of(*one), beyond), number_of(*other));
  }

  static std::int64_t number_of(const Json& line) {
    const Json* number = line.find("n");
    return number != nullptr && number->is_number() ? static_cast<std::int64_t>(number->number()) : 0;
  }
  std::int64_t last() const { return again_.journal.empty() ? 0 : number_of(again_.journal.back()); }
  static std::string where_of(const Json& line) {
    for (const char* name : {"function", "notebook", "event"})
      if (line.find(name) != nullptr)
        return "line " + std::to_string(number_of(line)) + ", " + text_in(line, name);
    return "line " + std::to_string(number_of(line));
  }

  using Digests = std::map<std::string, const Json*>;
  static Digests digests_in(const RecordedRun& run, std::string_view list) {
    Digests digests;
    const Json* entries = run.manifest.find(list);
    if (entries == nullptr) return digests;
    for (const Json& entry : entries->list())
      if (entry.is_object()) digests.emplace(text_in(entry, "file"), entry.find("digest"));
    return digests;
  }
  static const Json* in(const Digests& digests, const std::string& file) {
    const auto place = digests.find(file);
    return place != digests.end() ? place->second : nullptr;
  }
  static Digests together(Digests one, const Digests& other) {
    one.insert(other.begin(), other.end());
    return one;
  }

  // What was read is the same or not, whatever laws there are.
  void compare_inputs() {
    const Digests then = digests_in(recorded_, "inputs"), now = digests_in(again_, "inputs");
    for (const auto& [file, digest] : together(then, now)) {
      const Json *one = in(then, file), *other = in(now, file);
      if (one != nullptr && other != nullptr && *one == *other) continue;
      // Earlier versions did not list script files.
      if (one == nullptr && again_.loaded.contains(file)) continue;
      result_.differences.push_back({"input " + quoted(file), brief(one), brief(other)});
    }
  }

  void compare_outputs() {
    const Digests then = digests_in(recorded_, "outputs"), now = digests_in(again_, "outputs");
    for (const auto& [file, digest] : together(then, now)) {
      const bool was = then.contains(file), is = now.contains(file);
      if (was && is) {
        const Json *one = in(then, file), *other = in(now, file);
        if (one == nullptr || other == nullptr || !(*one == *other)) result_.outputs.push_back(file);
      } else if (was || !file.ends_with(".xdmf")) {
        found({"output " + quoted(file), brief(in(then, file)), brief(in(now, file))}, last());
      }
    }
  }

  void compare_verdicts() {
    const auto passed = [](const RecordedRun& run) {
      std::string verdicts;
      if (const Json* list = run.manifest.find("expectations"))
        for (const Json& verdict : list->list()) {
          const Json* yes = verdict.is_object() ? verdict.find("passed") : nullptr;
          verdicts += std::string(verdicts.empty() ? "" : ", ") +
                      (yes != nullptr && *yes == Json(true) ? "passed" : "failed");
        }
      return verdicts;
    };
    const std::string then = passed(recorded_), now = passed(again_);
    if (then != now) found({"expectations", then, now}, last());
  }

  const RecordedRun &recorded_, &again_;
  const std::span<const LawMet> met_;
  const ColumnScales columns_;
  AcrossVersions result_;
};

}  // namespace

AcrossVersions compare_across_versions(const RecordedRun& recorded, const RecordedRun& again,
                                       std::span<const LawMet> met) {
  return Comparison(recorded, again, met).made();
}

}  // namespace asperity
