// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of contacts over random scenes. A failing scene is reduced and printed.
//
//   test_properties                              every family, as many scenes each as in CI
//   test_properties family=events scenes=100000  one family for a night
//   test_properties family=events seed=7 first=42 scenes=1   one scene again
//   test_properties family=explain cells=1000 scenes=120     tiles of up to so many cells a side
//
// Defaults: ASPERITY_SCENES, ASPERITY_SEED. ASPERITY_SHARE=0.05 runs a twentieth of CI's scenes.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

bool counts_scenes = true;
std::uint64_t scene_in_turn = 0;

namespace {

const Family* const families[] = {&conditions,         &monotony, &rescaling, &symmetry, &events,
                                  &events_of_elements, &threads,  &controls,  &explain};

struct Settings {
  std::string family;
  std::uint64_t seed = 1, first = 0;
  int scenes = 0;    // the family's own
  int cells = 0;     // the family's own
  double share = 1;  // of the family's scenes
};

[[noreturn]] void usage(const std::string& word) {
  std::fprintf(stderr, "%s is none of family=, scenes=, cells=, seed=, first=\n", word.c_str());
  std::exit(2);
}

Settings read(int count, char** words) {
  Settings settings;
  if (const char* value = std::getenv("ASPERITY_SCENES")) settings.scenes = std::atoi(value);
  if (const char* value = std::getenv("ASPERITY_SHARE")) settings.share = std::atof(value);
  if (const char* value = std::getenv("ASPERITY_SEED")) settings.seed = std::strtoull(value, nullptr, 10);
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    const auto equals = word.find('=');
    const std::string key = word.substr(0, equals),
                      value = equals < word.size() ? word.substr(equals + 1) : "";
    if (key == "family")
      settings.family = value;
    else if (key == "scenes")
      settings.scenes = std::atoi(value.c_str());
    else if (key == "cells")
      settings.cells = std::atoi(value.c_str());
    else if (key == "seed")
      settings.seed = std::strtoull(value.c_str(), nullptr, 10);
    else if (key == "first")
      settings.first = std::strtoull(value.c_str(), nullptr, 10);
    else
      usage(word);
  }
  return settings;
}

Verdict judged(const Family& family, const Trial& trial, std::uint64_t salt, int& refused) {
  try {
    return family.check(trial, salt);
  } catch (const RefusedByName&) {
    ++refused;
    return {};
  } catch (const Error& error) {
    return Broken{"no " + std::string(name(error.code())) + " error", error.what()};
  }
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Failure {
  Trial trial;
  Broken broken;
};

Failure shrunk(const Family& family, Failure failure, std::uint64_t salt) {
  const double begin = seconds();
  int refused = 0;
  constexpr double patience = 20;  // s
  for (bool smaller = true; smaller && seconds() - begin < patience;) {
    smaller = false;
    for (const Trial& next : simpler(failure.trial)) {
      const Verdict verdict = judged(family, next, salt, refused);
      if (!verdict || verdict->property != failure.broken.property) continue;
      failure = {next, *verdict};
      smaller = true;
      break;
    }
  }
  return failure;
}

int run(const Family& family, const Settings& settings) {
  constexpr int shown_of_each = 1;
  const double begin = seconds();
  const int of_family = std::max(1, static_cast<int>(settings.share * family.scenes));
  const int scenes = settings.scenes > 0 ? settings.scenes : of_family;
  Wanted wanted = family.wanted;
  if (settings.cells > 0) wanted.most_cells = settings.cells;
  std::map<std::string, int> broken;
  int count = 0, refused = 0;
  for (int n = 0; n < scenes; ++n) {
    const std::uint64_t index = settings.first + static_cast<std::uint64_t>(n);
    const std::uint64_t salt = splitmix64(settings.seed, index);
    const Trial trial = draw_trial(settings.seed, index, wanted);
    scene_in_turn = index;
    const Verdict verdict = judged(family, trial, salt, refused);
    if (!verdict) continue;
    ++count;
    const std::string scene = "scene " + std::to_string(index) + " of seed " + std::to_string(settings.seed);
    std::printf("%s: broken by %s (%s): %s: %s\n", family.name, scene.c_str(), trial.heights.c_str(),
                verdict->property.c_str(), verdict->how.c_str());
    if (broken[verdict->property]++ >= shown_of_each) continue;
    counts_scenes = false;
    const Failure least = shrunk(family, {trial, *verdict}, salt);
    counts_scenes = true;
    std::printf("---- the smallest scene found that breaks it\n%s----\n",
                script(least.trial,
                       std::string(family.name) + ", " + scene + ", made smaller: " + least.broken.property +
                           "\n-- found: " + least.broken.how,
                       least.broken.lines)
                    .c_str());
    std::fflush(stdout);
  }
  if (family.after)
    if (const Verdict verdict = family.after()) {
      ++count;
      std::printf("%s: %s: %s\n", family.name, verdict->property.c_str(), verdict->how.c_str());
    }
  constexpr double most_refused = 0.02;
  if (refused > 1 + most_refused * scenes) {
    ++count;
    std::printf("%s: %d scenes were refused by name\n", family.name, refused);
  }
  std::printf("%s: %d scenes, %d broken, %d refused by name, %.1f s\n", family.name, scenes, count, refused,
              seconds() - begin);
  for (const auto& [property, times] : broken) std::printf("  %5d  %s\n", times, property.c_str());
  std::fflush(stdout);
  return count;
}

}  // namespace
}  // namespace asperity::stability

int main(int count, char** words) {
  using namespace asperity::stability;
  const Settings settings = read(count, words);
  asperity::set_thread_count(1);  // families run in parallel
  int broken = 0;
  bool known = settings.family.empty();
  for (const Family* family : families)
    if (settings.family.empty() || settings.family == family->name) {
      known = true;
      broken += run(*family, settings);
    }
  if (!known) usage("family=" + settings.family);
  return broken == 0 ? 0 : 1;
}
