// SPDX-License-Identifier: GPL-3.0-or-later
// A random scene with its mean pressure, drawn by key from a seed; simpler neighbours; a Lua script whose
// decimals restore every bit.
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
  std::string heights;  // their kind, for printing

  bool half_space() const { return scene.elasticity.is<HalfSpaceOptions>(); }
  bool rough_pair() const { return std::holds_alternative<Surface>(scene.upper); }
  // Smaller hardness of both bodies, Pa; infinite without plasticity.
  double hardness() const;
  bool hardens() const;
  // Upper bound of the pressure, Pa.
  double cap() const;
};

struct Wanted {
  enum class Model { any, box, half_space };
  Model model = Model::any;
  bool yields = false;  // every scene has a finite hardness
  bool pair = false;    // two rough bodies
  std::optional<double> tolerance{};
  double lightest = 1e-12, heaviest = 1e3;  // relative to the pressure of full flattening
  int most_cells = 48;                      // per side
  double longest = 1.5;                     // greatest |log10| of the cell aspect
};

// Scene `index` of a seed, independent of earlier draws.
Trial draw_trial(std::uint64_t seed, std::uint64_t index, const Wanted& wanted);

// Largest simplification first.
std::vector<Trial> simpler(const Trial& trial);

// Builds the scene bit for bit, presses, runs `lines`; `comment` is the first line.
std::string script(const Trial& trial, const std::string& comment, const std::string& lines);

// The shortest decimal that restores every bit.
std::string exact(double value);

// Each field is in its body's frame; `upper` is for a rough upper body only.
Scene with_heights(const Scene& scene, const Grid& grid, Field lower, Field upper);

}  // namespace asperity::stability
