// SPDX-License-Identifier: GPL-3.0-or-later
// Which contact a call of the language would press, and how often, as far as that is known before it is made.
#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/explanation.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "bindings/lua/specimen/tilt_stage.hpp"

namespace asperity::lua {

namespace {

// The contact that a call would press, if it is known.
const SpecimenPair* pressed_by(const Call& call, const Function& function) {
  const auto contact_at = [&](int k) -> const SpecimenPair* {
    const Object* object = Argument(call.L, k).as_any_object();
    if (object == nullptr || object->pointer == nullptr) return nullptr;
    if (object->type == &class_of<SpecimenPair>())
      return static_cast<const SpecimenPair*>(object->pointer.get());
    if (object->type == &class_of<TiltStage>())
      return static_cast<const TiltStage*>(object->pointer.get())->contact.get();
    return nullptr;
  };
  if (!function.heavy) return nullptr;
  const SpecimenPair* own = contact_at(1);
  return own != nullptr || call.count() < 1 ? own : contact_at(2);
}

// How often it would press: once, along the list of a sweep, at the events of a protocol, at probe pressures.
std::int64_t presses_of(const Call& call) {
  const Object* self = Argument(call.L, 1).as_any_object();
  if (self != nullptr && self->type == &class_of<Protocol>() && self->pointer != nullptr) {
    const auto& events = static_cast<const Protocol*>(self->pointer.get())->events();
    return std::count_if(events.begin(), events.end(), [](const Protocol::Event& event) {
      return std::holds_alternative<PressRequest>(event.step);
    });
  }
  // A stage solves at each of its probe pressures; it may raise them, which is not known here.
  if (self != nullptr && self->type == &class_of<TiltStage>() && self->pointer != nullptr) {
    const auto* stage = static_cast<const TiltStage*>(self->pointer.get());
    const bool probes = std::holds_alternative<HalfSpaceOptions>(stage->contact->scene().elasticity);
    return probes ? static_cast<std::int64_t>(stage->options.probe_pressures.size()) : 1;
  }
  std::int64_t presses = 1;
  if (call.given(1) && call.argument(1).is_table())
    call.argument(1).each([&](const Argument&, const Argument& loads) {
      if (loads.is_table()) presses = std::max(presses, loads.length());
    });
  return presses;
}

// The presses that it would make, each as often as it comes, as far as they are known before it.
std::vector<Explanation::Asked> known_presses_of(const Call& call, const Function& function) {
  const Object* self = Argument(call.L, 1).as_any_object();
  if (self == nullptr || self->pointer == nullptr) return {};
  std::vector<Explanation::Asked> asked;
  if (self->type == &class_of<SpecimenPair>())
    for (PressRequest& request : requests_of(call, function)) asked.push_back({std::move(request)});
  if (self->type != &class_of<Protocol>()) return asked;
  std::map<std::pair<PressBy, double>, std::size_t> known;
  for (const Protocol::Event& event : static_cast<const Protocol*>(self->pointer.get())->events()) {
    const auto* press = std::get_if<PressRequest>(&event.step);
    if (press == nullptr) continue;
    const auto [at, first] = known.try_emplace({press->by, press->value}, asked.size());
    if (first)
      asked.push_back({*press});
    else
      ++asked[at->second].times;
  }
  return asked;
}

}  // namespace

void note_call(Explanation& explanation, const Call& call, const Function& function) {
  if (const SpecimenPair* pair = pressed_by(call, function))
    explanation.note(*pair, call.function_name(), known_presses_of(call, function), presses_of(call));
  else if (function.returns.find("State") != std::string::npos)
    explanation.note_unplanned(call.function_name());
}

}  // namespace asperity::lua
