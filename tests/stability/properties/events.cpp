// SPDX-License-Identifier: GPL-3.0-or-later
// A repeated or lighter event changes less than ten times the tolerance of the first. A load and a greater
// load end like the greater load alone. Turns without load change nothing. Gaps are accurate to the
// tolerance times the rms height; volumes are compared with the larger of the plastic volume and the rms
// height over the yielded area.
#include <cmath>
#include <limits>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

PressRequest under(double pressure) { return {PressBy::pressure, pressure, {}}; }

bool same_heights(const Surface& a, const Surface& b) { return a.digest() == b.digest(); }

Verdict turns_change_nothing(const Trial& trial, const Stream& stream) {
  SpecimenPair pair(trial.scene);
  const Surface lower = pair.lower(), upper = pair.upper();
  const State before = pair.press(under(0));
  for (std::uint64_t n = 0; n < 5; ++n) {
    pair.place(stream.bits(n));
    pair.press(under(0));
    pair.release();
  }
  if (trial.scene.boundary == Boundary::free) try {
      for (std::uint64_t n = 10; n < 13; ++n) {
        pair.rotate(stream.uniform(n, -3, 3));
        pair.press(under(0));
      }
    } catch (const Error& error) {  // a turned strip may meet nothing, or nothing rough
      const auto says = [&](const char* part) { return error.sentence().find(part) != std::string::npos; };
      if (error.code() != ErrorCode::bad_value || !(says("turned") || says("heights are equal"))) throw;
    }
  if (!same_heights(pair.lower(), lower) || !same_heights(pair.upper(), upper))
    return Broken{"turns without load change no bit", "a body changed"};
  return {};
}

constexpr double allowed = 10;  // tolerances
// Rounding of a flat, relative to the approach.
constexpr double flat = 1e-3;

double greatest(const Surface& surface) {
  const Range heights = surface.height_range();
  return std::max(std::abs(heights.min), std::abs(heights.max));
}

// Smallest detectable plastic volume: gap tolerance and height rounding over the yielded area.
double unseen(const Trial& trial, const State& state) {
  const double rms = rms_height(state), length = rms > flat * state.approach() ? rms : state.approach();
  const double ground = state.plastic_fraction() * state.geometry().grid().area();
  const auto* rough = std::get_if<Surface>(&trial.scene.upper);
  const double heights = greatest(trial.scene.lower) + (rough ? greatest(*rough) : 0.0);
  return allowed * trial.scene.accuracy.tolerance * std::max(state.plastic_volume(), length * ground) +
         0x1p-52 * heights * ground;
}

Trial taking_the_best(const Trial& trial) {
  Trial result = trial;
  result.scene.accuracy.on_failure = Accuracy::OnFailure::best;
  return result;
}

// Flattened heights may be too even for the tolerance.
std::optional<Broken> press(SpecimenPair& pair, const Trial& trial, double pressure,
                            std::optional<State>& state) {
  Trial pressed = trial;
  pressed.scene = pair.scene();  // current heights
  state = pair.press(under(pressure));
  if (state->converged()) return {};
  if (doubles_hold_no_more(pressed, *state)) {
    state.reset();
    return {};
  }
  return Broken{"the certificate is met", exact(state->residual()) + " by " + std::string(state->solver())};
}

// One ulp more load: the change is the error of both solves.
Verdict the_ground_fits(const Trial& trial, SpecimenPair pair, const State& first) {
  std::optional<State> again;
  const double more = std::nextafter(trial.pressure, std::numeric_limits<double>::infinity());
  if (!(more < trial.cap())) return {};
  if (auto broken = press(pair, trial, more, again)) return broken;
  if (!again || again->plastic_volume() <= unseen(trial, first)) return {};
  return Broken{"ground that yielded fits", exact(again->plastic_volume() / first.plastic_volume()) +
                                                " of the first at tolerance " +
                                                exact(trial.scene.accuracy.tolerance)};
}

Verdict a_repeat_takes_nothing(const Trial& trial, const Stream& stream) {
  SpecimenPair pair(trial.scene);
  std::optional<State> first, again;
  if (auto broken = press(pair, trial, trial.pressure, first)) return broken;
  if (!first) return {};
  pair.release();
  if (auto broken = the_ground_fits(trial, pair, *first)) return broken;
  double repeats = 0;
  for (const double share : {1.0, stream.uniform(30, 0.1, 1), 1.0}) {
    pair.release();
    if (auto broken = press(pair, trial, share * trial.pressure, again)) return broken;
    if (!again) return {};
    repeats += again->plastic_volume();
  }
  if (repeats == 0 || repeats < allowed * trial.scene.accuracy.tolerance * first->plastic_volume()) return {};
  return Broken{"a repeated event takes nothing more",
                exact(repeats / first->plastic_volume()) + " of the first at tolerance " +
                    exact(trial.scene.accuracy.tolerance),
                "c:release()\nlocal again = c:press{ pressure=st.pressure }\n"
                "print(again.plastic_volume / st.plastic_volume)\n"};
}

Verdict the_greater_load_decides(const Trial& trial, const Stream& stream) {
  const double less = trial.pressure * stream.uniform(20, 0.05, 0.99);
  SpecimenPair twice(trial.scene), once(trial.scene);
  std::optional<State> first, second, alone;
  if (auto broken = press(twice, trial, less, first)) return broken;
  twice.release();
  if (auto broken = press(twice, trial, trial.pressure, second)) return broken;
  if (auto broken = press(once, trial, trial.pressure, alone)) return broken;
  if (!first || !second || !alone) return {};
  const double both = first->plastic_volume() + second->plastic_volume();
  if (std::abs(both - alone->plastic_volume()) <= unseen(trial, *alone) + unseen(trial, *first)) return {};
  return Broken{"a load and then a greater one take what the greater takes alone",
                exact(both) + " against " + exact(alone->plastic_volume()) + " m^3 at tolerance " +
                    exact(trial.scene.accuracy.tolerance)};
}

Verdict check(const Trial& given, std::uint64_t salt) {
  const Trial trial = taking_the_best(given);
  const Stream stream(salt, "events");
  if (auto broken = turns_change_nothing(trial, stream)) return broken;
  if (!trial.scene.effects.find<PlasticityOptions>()) return {};
  if (auto broken = a_repeat_takes_nothing(trial, stream)) return broken;
  return the_greater_load_decides(trial, stream);
}

}  // namespace

const Family events{
    "events", {.model = Wanted::Model::half_space, .yields = true, .heaviest = 10}, check, 1000};
const Family events_of_elements{
    "events_of_elements", {.model = Wanted::Model::box, .yields = true, .heaviest = 10}, check, 1000};

}  // namespace asperity::stability
