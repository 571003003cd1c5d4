// SPDX-License-Identifier: GPL-3.0-or-later
// A model of elasticity: one record in one folder of elasticity/. Readers, checks, plans, solvers and
// documents iterate over the records (elasticity/list.hpp).
#pragma once

#include <any>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/options.hpp"

namespace asperity {

class ContactGeometry;
class Solver;
struct Plan;
struct Scene;

struct ElasticModel {
  std::string_view name;    // key in a script: "half_space"
  std::string_view noun;    // in sentences: "a half-space"
  std::string_view called;  // without article
  std::string sentence;     // lower case, no full stop
  // Every pressure displaces every node: iterative solves, coupled across a periodic rim. Otherwise closed
  // form, node by node.
  bool moves_every_node = false;
  std::any defaults;  // its options struct
  std::vector<OptionRow> options;
  std::string boundary{};  // error if the scene gives none; empty: default allowed
  bool periodic_only = false;
  bool over_ranks = false;  // supported by lab.spread
  // Throws Error for a scene outside this model; option ranges are already checked. May be null.
  void (*check)(const std::any& options, const Scene& scene) = nullptr;
  // Adds operator, term, buffers, solver name, expected transforms and time.
  void (*plan)(const std::any& options, const ContactGeometry& geometry, Plan& plan);
  // Runs after the effects. May be null.
  void (*finish)(const ContactGeometry& geometry, Plan& plan) = nullptr;
  // Replaces defaulted options by the values of `before`, for bodies that yielded since or have other cells.
  // Null: options unchanged.
  std::any (*as_planned)(const std::any& options, const Plan& before) = nullptr;
  // Does the work independent of the load.
  std::shared_ptr<const Solver> (*solver)(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry);
};

// The model of a scene with its options. Each options struct has static const ElasticModel& model().
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

}  // namespace asperity
