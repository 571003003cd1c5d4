// SPDX-License-Identifier: GPL-3.0-or-later
// How the bodies of a scene give way: a model of elasticity is a record of one folder of elasticity/, with
// its options, what it needs, what it adds to a plan and the solver that carries the plan out. Whoever reads
// a scene, checks, plans, solves or documents walks these records (elasticity/list.hpp).
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
  std::string_view name;    // "half_space", as a script names it
  std::string_view noun;    // "a half-space", in sentences
  std::string_view called;  // the same without an article
  std::string sentence;     // what it is, lower case, no full stop
  // Whether every pressure moves every node, so that a press is solved by iterations and feels what lies
  // across the rim of a periodic tile. Else the nodes are solved one by one, in closed form.
  bool moves_every_node = false;
  std::any defaults;  // the struct of its options
  std::vector<OptionRow> options;
  std::string boundary{};  // what is said where a scene gives none; empty: it may
  bool periodic_only = false;
  bool over_ranks = false;  // whether lab.spread computes it
  // Throws Error for a scene that this model does not compute; the ranges of the options were checked before.
  // May be null.
  void (*check)(const std::any& options, const Scene& scene) = nullptr;
  // Fills operator, term, buffers, solver name, expected transforms and time.
  void (*plan)(const std::any& options, const ContactGeometry& geometry, Plan& plan);
  // Completes the plan after the effects have added theirs. May be null.
  void (*finish)(const ContactGeometry& geometry, Plan& plan) = nullptr;
  // The options with their defaults replaced by the values of the plan `before`, for bodies that have yielded
  // since or lie on other cells. Null: the options stay as they were given.
  std::any (*as_planned)(const std::any& options, const Plan& before) = nullptr;
  // The contact made ready to be pressed: the work that does not depend on the load is done here.
  std::shared_ptr<const Solver> (*solver)(const Plan& plan, std::shared_ptr<const ContactGeometry> geometry);
};

// The model that a scene names, with its options. The struct of a model's options says which it is:
// static const ElasticModel& model().
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
  // Null of another model.
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
