// SPDX-License-Identifier: GPL-3.0-or-later
// A solver's result: the few numbers of the solve, and members that compute the rest on request. Nodes
// without a counterpart (combined height NaN) carry nothing. Immutable: any thread may call any member and
// gets the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/plan.hpp"
#include "engine/core/cost.hpp"

namespace asperity {

// Contacts, divided at a pressure.
struct PressureSplit {
  std::int64_t above = 0;  // p >= threshold
  std::int64_t below = 0;  // 0 < p < threshold
  double sum_below = 0;    // Σ p of `below`, Pa
};

struct PlacedContact {
  std::shared_ptr<const Plan> plan;
  std::shared_ptr<const ContactGeometry> geometry;
};

class Solution {
 public:
  struct Numbers {
    double load = 0;            // N on the tile
    double pressure = 0;        // Pa, load over nominal area
    double approach = 0;        // m
    double peak_pressure = 0;   // Pa
    std::int64_t contacts = 0;  // nodes with p > 0
    std::int64_t yielded = 0;   // nodes at the cap, or past the yield pressure
    int iterations = 0;
    std::string solver{};
    // N on the tile; adds to the load on the junctions.
    double attraction = 0;
    std::vector<double> preload{};  // turning points; they select the branch
  };

  virtual ~Solution() = default;

  const ContactGeometry& geometry() const { return *contact_.geometry; }
  const Plan& plan() const { return *contact_.plan; }
  const std::shared_ptr<const Plan>& shared_plan() const { return contact_.plan; }
  const Numbers& numbers() const { return numbers_; }

  // Computed on request; zero without yield.
  virtual double plastic_volume() const { return 0; }  // m³, both bodies
  virtual std::optional<PlasticChange> plastic_change() const { return {}; }
  // This solution alone.
  virtual std::int64_t bytes() const { return 0; }
  virtual double flatten() const = 0;    // relative fall of the combined peak-to-valley
  virtual double stiffness() const = 0;  // Pa/m, d pressure / d approach at constant contact set
  virtual double mean_gap() const = 0;   // m, over facing nodes
  virtual double energy() const = 0;     // J in the tile, elastic
  virtual Certificate certificate() const = 0;
  // Bounds on the same grid.
  virtual SolutionError error() const = 0;
  virtual PressureSplit split(double threshold) const = 0;
  Array<std::uint8_t> contact_mask() const;      // 1 where p > 0, row by row
  virtual Field pressure_field() const = 0;      // Pa
  virtual Field gap_field() const = 0;           // m, 0 in contact; undefined off the overlap
  virtual Field displacement_field() const = 0;  // m, elastic, both bodies, positive into them
  // m, in the body's own frame.
  virtual Field lower_under_load() const;
  Field upper_under_load() const;

 protected:
  Solution(PlacedContact contact, Numbers numbers)
      : contact_(std::move(contact)), numbers_(std::move(numbers)) {}

 private:
  // `share`: of the displacement.
  Field under_load(const Field& before, double share, bool upper) const;

  PlacedContact contact_;
  Numbers numbers_;
};

// Bounds (not estimates) of absolute differences from the exact solution of the request on the same grid,
// from the pressures. Includes rounding, in the unit of the quantity; infinite if unknown.
struct AlgebraicError {
  // Only rounding if prescribed. None after a press by `flatten`: other bounds then refer to the load found.
  std::optional<double> load, pressure;
  double approach = 0;
  double indentation = 0;  // infinite for equal combined heights
  double separation = 0;
  double mean_gap = 0;
  double energy = 0;
  double peak_pressure = 0;
  std::optional<double> secant_stiffness;  // none without one for the load
  double contacts = 0, area = 0, area_fraction = 0;
  double corrected_area_fraction = 0;
  NodeBracket contact_bracket;
  // None without the effect `plasticity`.
  std::optional<double> plastic_volume, plastic_fraction;
  std::optional<NodeBracket> yielded_bracket;

  std::int64_t nodes = 0;  // of the grid
  double node_area = 0;    // m²
  Cost cost;               // of computing this
};

// As costly as solution.error().
AlgebraicError find_algebraic_error(const Solution& solution);

}  // namespace asperity
