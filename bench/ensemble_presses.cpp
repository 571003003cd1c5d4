// SPDX-License-Identifier: GPL-3.0-or-later
// Overhead of lab.ensemble: bench/ensemble_presses.lua against a loop over the same surfaces and presses, on
// as many threads. Processor times (user and system) of alternating runs; the ratio compares neighbours.
//
//   bench_ensemble_presses PROGRAM SCRIPT                       1000 cases, two threads, three rounds
//   bench_ensemble_presses PROGRAM SCRIPT cases=16000 rounds=1  other settings
//   bench_ensemble_presses PROGRAM SCRIPT capped=1000           presses that stop at the hardness
//
// Settings: cases=, capped=, cells=, threads=, rounds=, store=0 (no stored cases). One line per round, then
// the median ratio.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/core/parallel.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace {

using namespace asperity;

struct Spent {
  double processor = 0, wall = 0;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double processor_time(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Work>
Spent spent(int who, Work work) {
  const double before = processor_time(who);
  const auto begun = std::chrono::steady_clock::now();
  work();
  return {processor_time(who) - before,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count()};
}

using Settings = std::map<std::string, int>;

double area_of(int seed, const Settings& set) {
  Material material;
  material.young = 1e9;
  material.poisson = 0;
  material.hardness = 5e7;
  SelfAffineOptions o;
  o.grid = Grid{set.at("cells"), set.at("cells"), 1, 1};
  o.hurst = 0.8;
  o.rms_slope = 0.1;
  o.roll_off = 0.5;
  o.short_wave = 1.0 / 32;
  o.seed = static_cast<std::uint64_t>(seed);
  Scene scene{self_affine_surface(o).with_material(material), rigid_material(), Boundary::periodic,
              HalfSpaceOptions{}, Accuracy{}};
  scene.accuracy.tolerance = 1e-2;
  if (seed <= set.at("capped")) scene.effects.set(PlasticityOptions{});
  const State state = SpecimenPair(scene).press({PressBy::pressure, 5e6, {}});
  return state.corrected_area_fraction();
}

void loop(const Settings& set) {
  const int cases = set.at("cases");
  std::vector<double> areas(static_cast<std::size_t>(cases));
  std::atomic<int> next = 0;
  {
    std::vector<std::jthread> workers;
    for (int k = 0; k < set.at("threads"); ++k)
      workers.emplace_back([&] {
        const SingleThreaded alone;
        for (int seed = ++next; seed <= cases; seed = ++next)
          areas[static_cast<std::size_t>(seed - 1)] = area_of(seed, set);
      });
  }
  double sum = 0;
  for (const double area : areas) sum += area;
  std::printf("  area fraction %.17g\n", sum / cases);
}

void run_script(const std::string& program, const std::string& script, const Settings& set,
                const std::string& folder) {
  std::vector<std::string> words = {program, "run",  script, "--threads", std::to_string(set.at("threads")),
                                    "--out", folder, "--"};
  if (set.at("store") == 0) words.insert(words.end() - 1, {"--store-limit", "0"});
  for (const char* name : {"cases", "capped", "cells"})
    words.push_back(std::string(name) + "=" + std::to_string(set.at(name)));
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(program.c_str(), argv.data());
    std::_Exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
    std::fprintf(stderr, "%s did not run %s\n", program.c_str(), script.c_str());
    std::exit(1);
  }
}

}  // namespace

int main(int count, char** words) {
  Settings set = {{"cases", 1000}, {"capped", 0}, {"cells", 256},
                  {"threads", 2},  {"rounds", 3}, {"store", 1}};
  for (int k = 3; k < count; ++k) {
    const std::string word = words[k];
    const std::size_t at = word.find('=');
    if (at == std::string::npos || !set.contains(word.substr(0, at))) {
      std::fprintf(stderr, "%s is none of cases=, capped=, cells=, threads=, rounds=, store=\n", words[k]);
      return 2;
    }
    set[word.substr(0, at)] = std::atoi(word.c_str() + at + 1);
  }
  if (count < 3) {
    std::fprintf(stderr, "usage: bench_ensemble_presses PROGRAM SCRIPT [cases=1000 ...]\n");
    return 2;
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("asperity-bench-" + std::to_string(getpid()));
  std::vector<double> ratios;
  for (int round = 0; round < std::max(1, set["rounds"]); ++round) {
    std::fflush(stdout);
    const Spent script =
        spent(RUSAGE_CHILDREN, [&] { run_script(words[1], words[2], set, folder.string()); });
    std::filesystem::remove_all(folder);
    const Spent bare = spent(RUSAGE_SELF, [&] { loop(set); });
    ratios.push_back(script.processor / bare.processor);
    std::printf("  ensemble %.2f s of processors, %.2f s in all; bare loop %.2f s, %.2f s; ratio %.3f\n",
                script.processor, script.wall, bare.processor, bare.wall, ratios.back());
  }
  std::ranges::sort(ratios);
  std::printf("%d cases, %d of them capped, %d threads: middle ratio %.3f\n", set["cases"], set["capped"],
              set["threads"], ratios[ratios.size() / 2]);
}
