// SPDX-License-Identifier: GPL-3.0-or-later
// An effect of a scene: one record in one file of effects/. Readers, checks, plans, presses and documents
// iterate over the records (known_effects.hpp) and name no effect.
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

// In costs and reports; no record.
inline constexpr std::string_view elasticity_effect = "elasticity";

struct Effect {
  enum class Acts {
    adds_term,        // an energy of the gap
    bounds_pressure,  // the excess deforms the bodies
    scales_bound,     // by the dwell time
    reads_state,      // computed after the solve
  };

  std::string_view name;  // the key in a scene's `effects`
  std::string sentence;   // lower case, no full stop
  Acts acts;
  std::any defaults;  // its options struct
  std::vector<OptionRow> options;
  // Throws Error for conflicting options, missing requirements or unsupported combinations; ranges are
  // already checked. May be null.
  void (*check)(const std::any& options, const Scene& scene) = nullptr;
  // Adds terms, pressure bound, buffers, warnings, completed options. Throws Error naming effect and body for
  // a missing property.
  void (*plan)(const std::any& options, const ContactGeometry& geometry, Plan& plan);
  // Adds permanent changes (bodies/after_event.hpp). May be null.
  void (*leave)(const State& state, const Plan& plan, AfterEvent& after) = nullptr;
  // BodyMemory of `leave`; empty: none. Part of a state's digest for effects of reads_state.
  std::string_view keeps = {};
  // May be null.
  std::vector<StateQuantity> (*quantities)() = nullptr;
  bool over_ranks = false;  // supported by lab.spread
};

// Each options struct has static const Effect& effect().
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

  // Replaces earlier options.
  void set(const Effect& effect, std::any options);
  template <class O>
  void set(O options) {
    set(O::effect(), std::any(std::move(options)));
  }
  template <class O>
  void remove() {
    std::erase_if(named_, [](const Named& known) { return known.effect == &O::effect(); });
  }

  // Null if not named.
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
  // Without effects of reads_state.
  Effects of_solve() const;
  auto begin() const { return named_.begin(); }
  auto end() const { return named_.end(); }

 private:
  std::vector<Named> named_;
};

// Listed effects with this action; effects_that(): in a sentence, "`capillarity` or `adhesion`".
std::vector<std::string> effect_names(Effect::Acts acts);
std::string effects_that(Effect::Acts acts);

// Throws Error{bad_state}: `what` needs an effect.
[[noreturn]] void refuse_without(const std::string& what, const std::string& quoted_effect,
                                 std::string hint = {});

}  // namespace asperity
