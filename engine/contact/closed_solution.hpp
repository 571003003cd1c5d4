// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of a solution once its contact was closed and its memory is free: the few numbers that were
// known when the solve ended. Whatever would have to be worked out now throws Error{bad_state} that names it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/solution.hpp"

namespace asperity {

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
