// SPDX-License-Identifier: GPL-3.0-or-later
// A contact under load: an immutable value, cheap to copy, thread-safe. Quantities are computed on first
// request and cached. Areas and fractions refer to the nominal tile; spots and outline wrap only around a
// periodic rim.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/algebraic_error.hpp"
#include "engine/contact/distribution.hpp"
#include "engine/contact/outline_area.hpp"
#include "engine/contact/scene/effect.hpp"
#include "engine/contact/solution.hpp"
#include "engine/core/cost.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct ChosenAccuracy;
class CompanionGrids;
struct GapTerm;
struct Plan;

struct StateCost {
  Cost total;
  std::vector<std::pair<std::string, Cost>> by_effect;

  StateCost& operator+=(const StateCost& other);
};
StateCost elasticity_alone(const Cost& cost);

class State {
 public:
  State(std::shared_ptr<const Solution> solution, const Plan& plan, StateCost cost);

  double load() const;      // N on the tile
  double pressure() const;  // Pa, load over nominal area
  // N on the tile: attraction across the gap. Contacts carry load() + attraction().
  double attraction() const;
  // PressRequest::preload.
  std::vector<double> preload() const;
  double approach() const;  // m from first touch
  // m from first touch of the unworn bodies: approach() plus wear of the highest point.
  double displacement() const;
  // m between the mean planes where the bodies face each other: without elastic, with plastic deformation.
  double separation() const;
  // approach / peak-to-valley of the combined heights. Throws Error{bad_state} for flats.
  double indentation() const;
  double flatten() const;        // relative fall of this peak-to-valley, 0 … 1
  double area() const;           // m²
  double area_fraction() const;  // contacts / nodes of the tile
  // Share of nodes where the bodies face each other; 1 unless a turned upper body overhangs a free boundary.
  double overlap_fraction() const;
  // outline()->fraction, or area_fraction() less (π−1+ln 2)/24 of a cell per edge of the outline.
  double corrected_area_fraction() const;
  std::int64_t contacts() const;  // nodes with p > 0
  const Grid& grid() const;
  std::int64_t spots() const;              // regions joined by edges
  std::int64_t spots8() const;             // regions joined by edges or corners
  std::vector<double> spot_areas() const;  // m², regions joined by edges, largest first
  double peak_pressure() const;            // Pa
  double mean_gap() const;                 // m, mean of max(gap, 0) over facing nodes
  // Pa/m, d pressure / d approach at constant contact set; infinite at full periodic contact.
  double stiffness() const;
  // Pa/m, pressure / approach; 0 without both, infinite for flats under load.
  double secant_stiffness() const;
  double energy() const;  // J in the tile, elastic

  int iterations() const;
  const Certificate& certificate() const;
  double residual() const { return certificate().worst(); }
  // Against the exact solution on this grid. About three operator applications, counted in their own cost.
  const AlgebraicError& algebraic_error() const;
  bool converged() const;
  std::string solver() const;
  const std::vector<std::string>& effects_run() const;
  const std::vector<std::string>& effects_off() const;
  // With completed options.
  const Effects& effects() const;
  bool moves_every_node() const;                         // ElasticModel::moves_every_node
  const std::vector<GapTerm>& attraction_terms() const;  // with work above zero
  bool yields() const;                                   // whether an effect limits the pressure
  const StateCost& cost() const;                         // of the press only
  // Adds to the cost: work before or after the press.
  State costing_also(const StateCost& more) const;
  // For discretisation_error.hpp, and for a requested error; null if not requested.
  const std::shared_ptr<const CompanionGrids>& companion_grids() const { return companion_grids_; }
  const std::shared_ptr<const ChosenAccuracy>& chosen() const { return chosen_; }
  State beside(std::shared_ptr<const CompanionGrids> companion_grids) const;
  State chosen_as(std::shared_ptr<const ChosenAccuracy> chosen) const;
  // With an outline between the nodes, for bodies without attraction. `modulus`: E* in Pa, or the stiffness
  // of boxes in Pa/m. No outline if outline_area() gives none or the bodies do not cover the tile.
  State with_outline(double modulus, bool boxes = false) const;
  const std::optional<OutlineArea>& outline() const { return outline_; }
  // Digest of pressures, load, approach, and body memory of effects of reads_state.
  const std::string& digest() const;

  // In the lower body's frame: "pressure" (Pa), "gap" (m), "contact" (1 or 0), "displacement" (m, elastic),
  // "plastic" (m, plastic part of the approach). Without a counterpart the pressure is 0 and the gap NaN.
  // Throws Error{unknown_name}, or Error{bad_state} for "plastic" without a pressure limit.
  std::shared_ptr<const Field> field(std::string_view name) const;
  // "lower" or "upper" under load, in its own frame; a rigid body is unchanged.
  Surface deformed(std::string_view body) const;
  // "pressure" over contact nodes, "gap" over other facing nodes, "spot_area" over spots. Throws
  // Error{bad_state} without any.
  Histogram distribution(std::string_view name, const HistogramOptions& options = {}) const;
  // m³ removed from both bodies by this press; share of nodes at the pressure limit. 0 without a limit.
  double plastic_volume() const;
  double plastic_fraction() const;
  // None without yield.
  std::optional<PlasticChange> plastic_change() const;

  PressureSplit split(double threshold) const;
  const ContactGeometry& geometry() const;
  // After close(): a ClosedSolution.
  std::shared_ptr<const Solution> solution() const;
  // Memory of the solution, without bodies and cached quantities.
  std::int64_t bytes_held() const;
  // One line: values with algebraic errors, `of_the_cells` (discretisation error), residual, cost, solver.
  std::string text(const std::string& of_the_cells = {}) const;

  static std::span<const std::string> field_names();

  struct Shared;
  // Does not keep the state alive; used by a contact to close its states.
  using Watch = std::weak_ptr<Shared>;
  Watch watch() const;
  // Frees the solution. Values already read stay, also load, approach, contacts, peak pressure, certificate
  // and digest; others throw Error{bad_state}.
  static void close(const Watch& watch);
  bool closed() const;

 private:
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<const StateCost> cost_;
  std::shared_ptr<const CompanionGrids> companion_grids_;
  std::shared_ptr<const ChosenAccuracy> chosen_;
  std::optional<OutlineArea> outline_;
};

}  // namespace asperity
