// SPDX-License-Identifier: GPL-3.0-or-later
// An effect that a scene may name beside its elasticity. Each effect is one record in one file of effects/:
// its options, which other effects it needs, what it adds to a plan, what an event leaves of it on the
// bodies, and the quantities that only this effect gives. The sources that read, check, plan, press and
// document a scene walk these records (effects/list.hpp) and know no effect by name.
#pragma once

#include <any>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/options.hpp"

namespace asperity {

class ContactGeometry;
class State;
struct AfterEvent;
struct Plan;
struct Scene;
struct StateQuantity;

// The name of the elasticity in a scene, in costs and in reports. It has no record among the effects.
inline constexpr std::string_view elasticity_effect = "elasticity";

struct Effect {
  enum class Acts {
    adds_term,        // to the energy that a solve minimises: of the gap
    bounds_pressure,  // what passes the bound is left on the bodies
    scales_bound,     // by the time for which a load rests
    reads_state,      // of a contact that is solved without it; no solve knows of it
  };

  std::string_view name;  // the key in a scene's `effects`
  std::string sentence;   // what it does, lower case, no full stop
  Acts acts;
  std::any defaults;  // the struct of its options
  std::vector<OptionRow> options;
  // Throws Error for options that exclude each other, for a scene without what the effect needs, and for a
  // scene with something beside which the effect is not computed. The ranges of the options were checked
  // before. May be null.
  void (*check)(const std::any& options, const Scene& scene) = nullptr;
  // Fills the plan: its terms, the bound on its pressures, buffers, warnings, and the options with their
  // defaults filled in. Throws Error that names effect and body where a material lacks a property.
  void (*plan)(const std::any& options, const ContactGeometry& geometry, Plan& plan);
  // Adds to what a press of this state leaves on the bodies (bodies/after_event.hpp). Null: nothing stays.
  void (*leave)(const State& state, const Plan& plan, AfterEvent& after) = nullptr;
  // The BodyMemory that `leave` writes; empty: none. That of an effect which only reads states is part of
  // their digest; what a solve reads is in its pressures.
  std::string_view keeps = {};
  // Null: it gives none.
  std::vector<StateQuantity> (*quantities)() = nullptr;
  bool over_ranks = false;  // whether lab.spread computes it
};

// The effects that a scene names, each with its options. The struct of an effect's options says which it is:
// static const Effect& effect().
class Effects {
 public:
  struct Named {
    const Effect* effect;
    std::any options;
  };

  Effects() = default;
  template <class... O>
  requires(sizeof...(O) > 0 && requires { (O::effect(), ...); }) Effects(O... options) {
    (set(std::move(options)), ...);
  }

  // Instead of those it had.
  void set(const Effect& effect, std::any options);
  template <class O>
  void set(O options) {
    set(O::effect(), std::any(std::move(options)));
  }
  template <class O>
  void set(std::optional<O> options) {
    if (options)
      set(O::effect(), std::any(*std::move(options)));
    else
      remove<O>();
  }
  template <class O>
  void remove() {
    std::erase_if(named_, [](const Named& known) { return known.effect == &O::effect(); });
  }

  // Null where it is not named.
  const std::any* options_of(const Effect& effect) const;
  template <class O>
  const O* find() const {
    const std::any* options = options_of(O::effect());
    return options == nullptr ? nullptr : std::any_cast<O>(options);
  }
  template <class O>
  O* find() {
    return const_cast<O*>(std::as_const(*this).find<O>());
  }
  template <class O>
  bool has() const {
    return options_of(O::effect()) != nullptr;
  }
  bool names(std::string_view effect) const;
  bool any_that(Effect::Acts acts) const;
  // Without the effects that only read states: what a solve depends on.
  Effects of_solve() const;
  auto begin() const { return named_.begin(); }
  auto end() const { return named_.end(); }

 private:
  std::vector<Named> named_;
};

// The names of the listed effects (effects/list.hpp) that act so; and the same names for a sentence,
// "`capillarity` or `adhesion`".
std::vector<std::string> effect_names(Effect::Acts acts);
std::string effects_that(Effect::Acts acts);

// Throws Error{bad_state}: `what` needs an effect, or one of several, and the scene does not name it.
[[noreturn]] void refuse_without(const std::string& what, const std::string& quoted_effect,
                                 std::string hint = {});

}  // namespace asperity
