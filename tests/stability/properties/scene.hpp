// SPDX-License-Identifier: GPL-3.0-or-later
// A trial: a random scene and the mean pressure it is pressed with, drawn by key from a seed; its smaller
// neighbours, among which a failing one is followed down to the smallest that still fails; and its script,
// which anybody can run. Heights are printed in the fewest digits that give back every bit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/scene/scene.hpp"

namespace asperity::stability {

struct Trial {
  Scene scene;
  double pressure = 0;  // Pa
  std::string heights;  // what kind they are, for the reader

  bool half_space() const { return scene.elasticity.is<HalfSpaceOptions>(); }
  bool rough_pair() const { return std::holds_alternative<Surface>(scene.upper); }
  // The least hardness of the two bodies, Pa; infinite without plasticity.
  double hardness() const;
  bool hardens() const;
  // No pressure passes this, Pa: the hardness unless it hardens.
  double cap() const;
};

// What a family asks of its scenes.
struct Wanted {
  enum class Model { any, box, half_space };
  Model model = Model::any;
  bool yields = false;  // every scene has a finite hardness
  bool pair = false;    // two rough bodies
  std::optional<double> tolerance{};
  double lightest = 1e-12, heaviest = 1e3;  // of the pressure that about flattens the roughness
  int most_cells = 48;                      // a side
  double longest = 1.5;  // powers of ten that cells are longer than wide, or wider than long
};

// Scene `index` of a seed: the same whatever was drawn before.
Trial draw_trial(std::uint64_t seed, std::uint64_t index, const Wanted& wanted);

// Simpler neighbours, the greatest simplification first: fewer cells, one body, no yielding, plainer heights,
// rounder numbers.
std::vector<Trial> simpler(const Trial& trial);

// A Lua script that builds the scene to the last bit, presses it and then runs `lines`; `comment` heads it.
std::string script(const Trial& trial, const std::string& comment, const std::string& lines);

// A number of a script: the shortest decimal that gives back every bit.
std::string exact(double value);

// The same scene with other heights or another grid; `upper` counts only for a rough upper body and, like a
// lower body's field, is its own frame's.
Scene with_heights(const Scene& scene, const Grid& grid, Field lower, Field upper);

}  // namespace asperity::stability
