// SPDX-License-Identifier: GPL-3.0-or-later
// A solver's result: the few numbers of the solve, and members that compute the rest on request. Nodes
// without a counterpart (combined height NaN) carry nothing. Immutable: any thread may call any member and
// gets the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/algebraic_error.hpp"
#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/certificate.hpp"
#include "engine/contact/planned_yield.hpp"

namespace asperity {

// Nodes in contact, divided at a pressure.
struct PressureSplit {
  std::int64_t above = 0;  // p >= threshold
  std::int64_t below = 0;  // 0 < p < threshold
  double sum_below = 0;    // Σ p of `below`, Pa
};

// Permanent change of the bodies after a press.
struct PlasticChange {
  Field approach;  // w, m: plastic part of the local approach, both bodies
  // Pa, at the reference dwell, of yielded nodes; 0 elsewhere. Empty without hardening.
  Field hardness;
  // None if the solve missed its tolerance.
  std::optional<CarriedLoad> carried{};
};

class Solution {
 public:
  virtual ~Solution() = default;

  virtual const ContactGeometry& geometry() const = 0;

  // Each O(1).
  virtual double load() const = 0;      // N on the tile
  virtual double pressure() const = 0;  // Pa, load over nominal area
  virtual double approach() const = 0;  // m
  // N on the tile; an attraction across the gap adds this to the load on the junctions.
  virtual double attraction() const { return 0; }
  // Turning points of the load history; they select the branch.
  virtual std::span<const double> preload() const { return {}; }
  virtual std::int64_t contacts() const = 0;  // nodes with p > 0
  virtual double peak_pressure() const = 0;   // Pa
  virtual int iterations() const = 0;
  virtual std::string_view solver() const = 0;

  // Plasticity; all zero without yield.
  virtual std::int64_t yielded() const { return 0; }   // at the cap, or past the yield pressure
  virtual double plastic_volume() const { return 0; }  // m³, both bodies
  virtual std::optional<PlasticChange> plastic_change() const { return {}; }

  // Memory of this solution alone.
  virtual std::int64_t bytes() const { return 0; }

  // Computed on request.
  virtual double flatten() const = 0;    // relative fall of the peak-to-valley of the combined heights
  virtual double stiffness() const = 0;  // Pa/m, d pressure / d approach at constant contact set
  virtual double mean_gap() const = 0;   // m, over facing nodes
  virtual double energy() const = 0;     // J in the tile, elastic
  virtual Certificate certificate() const = 0;
  // Bounds against the exact solution on the same grid.
  virtual SolutionError error() const = 0;
  virtual PressureSplit split(double threshold) const = 0;
  virtual Array<std::uint8_t> contact_mask() const = 0;  // 1 where p > 0, row by row
  virtual Field pressure_field() const = 0;              // Pa
  virtual Field gap_field() const = 0;                   // m, 0 in contact; undefined off the overlap
  virtual Field displacement_field() const = 0;          // m, elastic, of both bodies, positive into them
  virtual Field lower_under_load() const = 0;            // m, in the lower body's frame
  virtual Field upper_under_load() const = 0;            // m, in the upper body's frame
};

// The numbers of a solve after the release of its memory. Other members throw Error{bad_state} naming the
// quantity.
class ClosedSolution final : public Solution {
 public:
  explicit ClosedSolution(const Solution& solution);

  double load() const override { return load_; }
  double pressure() const override { return pressure_; }
  double approach() const override { return approach_; }
  double attraction() const override { return attraction_; }
  std::span<const double> preload() const override { return preload_; }
  std::int64_t contacts() const override { return contacts_; }
  double peak_pressure() const override { return peak_pressure_; }
  int iterations() const override { return iterations_; }
  std::string_view solver() const override { return solver_; }
  std::int64_t yielded() const override { return yielded_; }

  const ContactGeometry& geometry() const override { not_read("a property of the bodies as they lay"); }
  double plastic_volume() const override { not_read("`plastic_volume`"); }
  std::optional<PlasticChange> plastic_change() const override { not_read("what yielded"); }
  double flatten() const override { not_read("`flatten`"); }
  double stiffness() const override { not_read("`stiffness`"); }
  double mean_gap() const override { not_read("`mean_gap`"); }
  double energy() const override { not_read("`energy`"); }
  Certificate certificate() const override { not_read("`certificate`"); }
  SolutionError error() const override { not_read("`error.algebraic`"); }
  PressureSplit split(double) const override { not_read("the pressure of each node"); }
  Array<std::uint8_t> contact_mask() const override { not_read("which nodes touch"); }
  Field pressure_field() const override { not_read("the field `pressure`"); }
  Field gap_field() const override { not_read("the field `gap`"); }
  Field displacement_field() const override { not_read("the field `displacement`"); }
  Field lower_under_load() const override { not_read("`deformed` of the lower body"); }
  Field upper_under_load() const override { not_read("`deformed` of the upper body"); }

 private:
  [[noreturn]] static void not_read(std::string_view what);

  double load_, pressure_, approach_, attraction_, peak_pressure_;
  std::vector<double> preload_;
  std::int64_t contacts_, yielded_;
  int iterations_;
  std::string solver_;
};

}  // namespace asperity
