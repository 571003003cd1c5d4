// SPDX-License-Identifier: GPL-3.0-or-later
// An elasticity is a record (ElasticModel) and an operator (ElasticOperator) in one folder of elasticity/.
// Readers, checks, plans, solvers and documents read both, and none asks for the model.
#pragma once

#include <any>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/contact/scene/boundary.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/options.hpp"

namespace asperity {

class ContactGeometry;
class ElasticOperator;
class Solver;
struct Plan;
struct Scene;
struct WaveShare;

struct ElasticModel {
  std::string_view name;    // key in a script: "half_space"
  std::string_view noun;    // in sentences: "a half-space"
  std::string_view called;  // without article
  std::string sentence;     // lower case, no full stop
  // A pressure displaces its own node alone: closed form. Otherwise all nodes: iterative, coupled across a
  // periodic rim.
  bool is_local = false;
  std::any defaults;  // its options struct
  std::vector<OptionRow> options;
  std::string boundary{};  // error without a boundary; empty: default allowed
  bool periodic_only = false;
  bool over_ranks = false;  // supported by lab.spread
  bool attraction = false;  // supports terms of the gap
  bool shear = true;        // supports partial slip
  // Throws Error for a scene outside this model; ranges are already checked. May be null.
  void (*check)(const std::any& options, const Scene& scene) = nullptr;
  // Throws Error naming effect and body for a missing property.
  std::shared_ptr<const ElasticOperator> (*make)(const std::any& options, const ContactGeometry& geometry);
};

// Two bodies together, u = K p: linear, symmetric, positive. SI units. Immutable.
class ElasticOperator {
 public:
  explicit ElasticOperator(const ElasticModel& of) : model(of) {}
  virtual ~ElasticOperator() = default;

  const ElasticModel& model;
  double modulus = 0;      // E*, Pa; local: stiffness in Pa/m, infinite for rigid bodies
  double lower_share = 1;  // of the displacement, 0 … 1
  std::string sentence;    // in a plan, with its numbers

  bool is_local() const { return model.is_local; }
  // m/Pa, at wavenumber q > 0 in 1/m.
  virtual double multiplier(double q) const = 0;
  // m/Pa, periodic; 0: the approach absorbs a uniform pressure.
  virtual double compliance_of_mean() const = 0;
  // Relative to a half-space; null: a half-space or local.
  virtual const WaveShare* wave_share() const { return nullptr; }
  // K p, m.
  virtual Field apply(const Field& pressure, const Grid& grid, Boundary boundary) const = 0;
  // K⁻¹ u of the mean-free part of u (periodic), Pa; if local, of all of u.
  virtual Field inverse(const Field& displacement, const Grid& grid) const = 0;

  // Adds buffers, solver name, expected transforms, time.
  virtual void plan(const ContactGeometry& geometry, Plan& plan) const = 0;
  // After the effects. Throws Error if they make the problem impossible.
  virtual void plan_after_effects(const ContactGeometry&, Plan&) const {}
  // Does all work independent of the load.
  virtual std::shared_ptr<const Solver> solver(const Plan& plan,
                                               std::shared_ptr<const ContactGeometry> geometry) const = 0;
};

// Each options struct has static const ElasticModel& model().
class Elasticity {
 public:
  Elasticity();  // box elements
  Elasticity(const ElasticModel& model, std::any options) : model_(&model), options_(std::move(options)) {}
  template <class O>
  requires requires { O::model(); }
  Elasticity(O options) : Elasticity(O::model(), std::any(std::move(options))) {}

  const ElasticModel& model() const { return *model_; }
  const std::any& options() const { return options_; }
  template <class O>
  bool is() const {
    return model_ == &O::model();
  }
  // Null for another model.
  template <class O>
  const O* find() const {
    return is<O>() ? std::any_cast<O>(&options_) : nullptr;
  }
  template <class O>
  O* find() {
    return is<O>() ? std::any_cast<O>(&options_) : nullptr;
  }

 private:
  const ElasticModel* model_;
  std::any options_;
};

// elasticity/list.cpp, in documentation order.
std::span<const ElasticModel* const> elastic_models();

// Throws Error{unknown_name} with the nearest known name.
const ElasticModel& require_elastic_model(std::string_view name);

}  // namespace asperity
