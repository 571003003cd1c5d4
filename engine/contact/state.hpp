// SPDX-License-Identifier: GPL-3.0-or-later
// A contact under load: an immutable value, cheap to copy. It keeps the solution and the bodies it
// was found for, works out each quantity when it is first asked for and keeps the answer; what nobody
// reads is never computed. Areas, fractions and spots are of the nominal tile; spots and the outline
// go round the rim only on a periodic boundary. Thread-safe.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/contact/algebraic_error.hpp"
#include "engine/contact/distribution.hpp"
#include "engine/contact/effect.hpp"
#include "engine/contact/outline_area.hpp"
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
// All of it taken by the elastic solve.
StateCost elasticity_alone(const Cost& cost);

class State {
 public:
  State(std::shared_ptr<const Solution> solution, const Plan& plan, StateCost cost);

  double load() const;      // N on the tile
  double pressure() const;  // Pa, load over nominal area
  // N on the tile, of an attraction across the gap: the contacts carry load() and this together.
  double attraction() const;
  // PressRequest::preload of the press; empty where the bodies came together from apart.
  std::vector<double> preload() const;
  double approach() const;  // m from first touch
  // m from first touch of the unworn bodies: approach() plus the wear of the highest point by earlier events.
  double displacement() const;
  // m, of the mean planes of the bodies where they face each other: elastic deformation is left out, plastic
  // deformation, also of this press, is included.
  double separation() const;
  // approach / peak-to-valley of the combined heights; throws Error{bad_state} for pressed flats, which have
  // none.
  double indentation() const;
  double flatten() const;        // share of that peak-to-valley pressed away, 0 … 1
  double area() const;           // m²
  double area_fraction() const;  // contacts over nodes of the tile
  // Share of the tile's nodes at which the bodies face each other; below 1 only where, on a free boundary,
  // the upper body is turned so that it does not cover the lower one.
  double overlap_fraction() const;
  // Less (π−1+ln 2)/24 of a cell for every edge of the outline; that within outline(), where it was found.
  double corrected_area_fraction() const;
  std::int64_t contacts() const;  // nodes with p > 0
  const Grid& grid() const;
  std::int64_t spots() const;              // regions of contact joined by an edge
  std::int64_t spots8() const;             // … or by a corner
  std::vector<double> spot_areas() const;  // m² of each region joined by edges, largest first
  double peak_pressure() const;            // Pa
  double mean_gap() const;                 // m, mean of max(gap, 0) over the nodes that face each other
  // Pa/m, d pressure / d approach at this contact set; infinite where all of a periodic tile touches.
  double stiffness() const;
  // Pa/m, pressure / approach; 0 without either, infinite where flats carry a load and come no nearer.
  double secant_stiffness() const;
  double energy() const;  // J in the tile, elastic

  int iterations() const;
  const Certificate& certificate() const;
  double residual() const { return certificate().worst(); }
  // Bounds on every quantity against the exact solution on this grid. Three applications of the operator or
  // so, counted in their own cost and not in that of the press.
  const AlgebraicError& algebraic_error() const;
  bool converged() const;
  std::string solver() const;
  const std::vector<std::string>& effects_run() const;
  const std::vector<std::string>& effects_off() const;
  // The effects of the scene, their options with the defaults filled in.
  const Effects& effects() const;
  bool moves_every_node() const;                         // ElasticModel::moves_every_node
  const std::vector<GapTerm>& attraction_terms() const;  // with work above zero
  bool yields() const;            // whether an effect limits the pressure, so that there is something plastic
  const StateCost& cost() const;  // of the press, not of what was asked afterwards
  // The same state with `more` added to its cost: work that was done for it before or after the press.
  State costing_also(const StateCost& more) const;
  // The same press on companion grids, from which discretisation_error.hpp estimates the error of the grid,
  // and the accuracy that was chosen for an error asked for. Null where the scene did not ask for them.
  const std::shared_ptr<const CompanionGrids>& companion_grids() const { return companion_grids_; }
  const std::shared_ptr<const ChosenAccuracy>& chosen() const { return chosen_; }
  State beside(std::shared_ptr<const CompanionGrids> companion_grids) const;
  State chosen_as(std::shared_ptr<const ChosenAccuracy> chosen) const;
  // The same press with an outline between the nodes, for bodies without attraction. `modulus` is E* in Pa,
  // or the stiffness of boxes in Pa/m. No outline if outline_area() gives none, or if the bodies do not cover
  // the tile.
  State with_outline(double modulus, bool boxes = false) const;
  const std::optional<OutlineArea>& outline() const { return outline_; }
  // Of pressures, load and approach, and of what earlier events left that effects read and no solve does.
  const std::string& digest() const;

  // "pressure" (Pa), "gap" (m), "contact" (1 or 0), "displacement" (m, elastic), "plastic" (m, the plastic
  // part of the approach); in the lower body's frame. Where nothing faces the lower body the pressure is 0
  // and the gap is missing (NaN). Throws Error{unknown_name}, or Error{bad_state} for "plastic" where
  // nothing limits the pressure.
  std::shared_ptr<const Field> field(std::string_view name) const;
  // The body under load, in its own frame: "lower" or "upper". A rigid one comes back as it was.
  Surface deformed(std::string_view body) const;
  // "pressure" over the nodes in contact, "gap" over the others where the bodies face each other, "spot_area"
  // over the spots. Throws Error{bad_state} when there are none.
  Histogram distribution(std::string_view name, const HistogramOptions& options = {}) const;
  // m³ that this press took from both bodies, and the share of the nodes at the limit of the pressure; 0
  // where nothing limits it.
  double plastic_volume() const;
  double plastic_fraction() const;
  // What this press leaves in the bodies; none where nothing yielded.
  std::optional<PlasticChange> plastic_change() const;

  // Nodes in contact at or above a pressure, and the sum of the rest.
  PressureSplit split(double threshold) const;
  const ContactGeometry& geometry() const;
  // What was solved, or of a closed state what is left of it.
  std::shared_ptr<const Solution> solution() const;
  // Memory that this state's solution keeps, without the bodies and what was worked out since.
  std::int64_t bytes_held() const;
  // One line for a reader: values with their algebraic errors, residual, cost and solver, and before the
  // residual what whoever estimates the error of the cells says of it.
  std::string text(const std::string& of_the_cells = {}) const;

  static std::span<const std::string> field_names();

  struct Shared;
  // A reference that does not keep the state alive, by which a contact closes the states pressed in it.
  using Watch = std::weak_ptr<Shared>;
  Watch watch() const;
  // Frees the memory of a solution. What was read of the state stays, and its load, approach, contacts, peak
  // pressure, certificate and digest; reading anything else throws Error{bad_state}.
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
