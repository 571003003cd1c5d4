// SPDX-License-Identifier: GPL-3.0-or-later
// A contact under load: an immutable value, cheap to copy, thread-safe. Quantities are computed on first
// request and cached. Areas and fractions refer to the nominal tile; spots and outline wrap only around a
// periodic rim.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/distribution.hpp"
#include "engine/contact/outline_area.hpp"
#include "engine/contact/scene/effect.hpp"
#include "engine/contact/solution.hpp"
#include "engine/core/cost.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

enum class PathDirection;  // regions.hpp

struct ChosenAccuracy;
class CompanionGrids;

struct StateCost {
  Cost total;
  std::vector<std::pair<std::string, Cost>> by_effect;

  StateCost& operator+=(const StateCost& other);
};
StateCost elasticity_alone(const Cost& cost);

class State {
 public:
  State(std::shared_ptr<const Solution> solution, StateCost cost);

  double load() const { return numbers_->load; }          // N on the tile
  double pressure() const { return numbers_->pressure; }  // Pa, load over nominal area
  // N on the tile. Contacts carry load() + attraction().
  double attraction() const { return numbers_->attraction; }
  // PressRequest::preload.
  const std::vector<double>& preload() const { return numbers_->preload; }
  double approach() const { return numbers_->approach; }  // m from first touch
  // m from first touch of the unworn bodies: approach() plus wear of the top.
  double displacement() const;
  // m between mean planes where the bodies face each other: without elastic, with plastic deformation.
  double separation() const;
  // Throws Error{bad_state} for flats.
  double indentation() const;
  double flatten() const;        // relative fall of this peak-to-valley
  double area() const;           // m²
  double area_fraction() const;  // contacts / nodes of the tile
  // Share of facing nodes; 1 unless a turned upper body overhangs.
  double overlap_fraction() const { return plan_->overlap; }
  // outline()->fraction, or area_fraction() less (π−1+ln 2)/24 of a cell per outline edge.
  double corrected_area_fraction() const;
  std::int64_t contacts() const { return numbers_->contacts; }  // nodes with p > 0
  const Grid& grid() const;
  std::int64_t spots() const;                 // regions joined by edges
  std::int64_t spots8() const;                // regions joined by edges or corners
  std::vector<double> spot_areas() const;     // m², regions joined by edges, largest first
  bool open_path(PathDirection along) const;  // nodes without contact join both sides by edges
  double peak_pressure() const { return numbers_->peak_pressure; }  // Pa
  double mean_gap() const;                                          // m, of max(gap, 0) over facing nodes
  // Pa/m, at constant contact set; infinite at full periodic contact.
  double stiffness() const;
  // Pa/m, pressure / approach; 0 without both, infinite for flats under load.
  double secant_stiffness() const;
  double energy() const;  // J in the tile, elastic

  int iterations() const { return numbers_->iterations; }
  const Certificate& certificate() const;
  double residual() const { return certificate().worst(); }
  // Against the exact solution on this grid. Costs about three operator applications, counted apart.
  const AlgebraicError& algebraic_error() const;
  bool converged() const { return residual() <= plan_->accuracy.tolerance; }
  const std::string& solver() const { return numbers_->solver; }
  const std::vector<std::string>& effects_run() const { return plan_->effects_run; }
  const std::vector<std::string>& effects_off() const { return plan_->effects_off; }
  // With completed options.
  const Effects& effects() const { return plan_->effects; }
  const Plan& plan() const { return *plan_; }
  bool yields() const { return plan_->yield.has_value(); }  // an effect limits the pressure
  // Only if every pressure displaces every node: a spot's area then errs by over 10 %.
  bool rests_on_few_nodes() const;
  const StateCost& cost() const { return *cost_; }  // of the press only
  // Work before or after the press.
  State costing_also(const StateCost& more) const;
  // For discretisation_error.hpp, and for a requested error; may be null.
  const std::shared_ptr<const CompanionGrids>& companion_grids() const { return companion_grids_; }
  const std::shared_ptr<const ChosenAccuracy>& chosen() const { return chosen_; }
  State beside(std::shared_ptr<const CompanionGrids> companion_grids) const;
  State chosen_as(std::shared_ptr<const ChosenAccuracy> chosen) const;
  // With an outline between nodes, for bodies without attraction. `modulus`: ElasticOperator::modulus. No
  // outline without outline_area() or full cover of the tile.
  State with_outline(double modulus) const;
  const std::optional<OutlineArea>& outline() const { return outline_; }
  // Covers pressures, load, approach, body memory for effects of reads_state.
  const std::string& digest() const;

  // Lower body's frame: "pressure" (Pa), "gap" (m), "contact" (1 or 0), "displacement" (m, elastic),
  // "plastic" (m, part of the approach). Without a counterpart: pressure 0, gap NaN. Throws
  // Error{unknown_name}, or Error{bad_state} for "plastic" without a pressure limit.
  std::shared_ptr<const Field> field(std::string_view name) const;
  // Own frame, "lower" or "upper"; rigid bodies are unchanged.
  Surface deformed(std::string_view body) const;
  // "pressure" over contacts, "gap" over other facing nodes, "spot_area" over spots. Throws Error{bad_state}
  // without any.
  Histogram distribution(std::string_view name, const HistogramOptions& options = {}) const;
  // m³ from both bodies in this press; share of nodes at the limit. 0 without a limit.
  double plastic_volume() const;
  double plastic_fraction() const;
  // None without yield.
  std::optional<PlasticChange> plastic_change() const;

  PressureSplit split(double threshold) const;
  const ContactGeometry& geometry() const;
  std::shared_ptr<const Solution> solution() const;
  // Without bodies and cached quantities.
  std::int64_t bytes_held() const;
  // One line: values with algebraic errors, `of_the_cells` (discretisation error), residual, cost, solver.
  std::string text(const std::string& of_the_cells = {}) const;

  static std::span<const std::string> field_names();

  struct Shared;
  // Does not keep the state alive; used to close states.
  using Watch = std::weak_ptr<Shared>;
  Watch watch() const;
  // Frees the solution. Values already read stay, also load, approach, contacts, peak pressure, certificate,
  // digest; others throw Error{bad_state}.
  static void close(const Watch& watch);
  bool closed() const;

 private:
  std::shared_ptr<Shared> shared_;
  const Plan* plan_;  // of shared_
  const Solution::Numbers* numbers_;
  std::shared_ptr<const StateCost> cost_;
  std::shared_ptr<const CompanionGrids> companion_grids_;
  std::shared_ptr<const ChosenAccuracy> chosen_;
  std::optional<OutlineArea> outline_;
};

// Sentences on validity, mostly none: few contacts, contact or attraction at the rim of a free tile, steep
// slopes, pressures near the contact modulus or above the hardness. Throws Error{bad_state} if closed. O(n),
// no transforms.
std::vector<std::string> state_limits(const State& state);

// HDF5 with XDMF: maps of shape (ny, nx) in the lower body's frame, all if none is named; load, approach,
// area, certificate, digest as root attributes. Throws Error{bad_file} for extensions other than .h5 or .hdf5
// and for disk errors, and as State::field.
void write_state(const State& state, const std::filesystem::path& path, std::vector<std::string> fields = {});

}  // namespace asperity
