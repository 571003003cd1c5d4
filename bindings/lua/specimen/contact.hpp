// SPDX-License-Identifier: GPL-3.0-or-later
// lab.contact, and contacts as native values of the language.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/friction/partial_slip.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

template <>
const Class& class_of<SpecimenPair>();

// The tables of c:press, c:place and c:shift, which events of a protocol share.
struct PressKeys {
  int given = 0;  // ways to say how far; exactly one is
  PressRequest request;
  std::optional<double> dwell;
  std::vector<double> preload;
};
const Block<PressKeys>& press_block();
// What a call of c:press or c:sweep, which `function` is, asks for; none where a dry run does not know it,
// and none of other calls. Throws as the call itself does.
std::vector<PressRequest> requests_of(const Call& call, const Function& function);
// Writes the journal's line of a press that an iterator made, as one made by hand stands there.
void record_press(const Session& session, const std::shared_ptr<SpecimenPair>& pair,
                  const PressRequest& request, const asperity::State& state);
struct PlaceKeys {
  std::uint64_t seed = 1;
};
const Block<PlaceKeys>& place_block();
struct ShiftKeys {
  double x = 0, y = 0;
};
const Block<ShiftKeys>& shift_block();

Function contact_function();

// contact:shear (shear.cpp) and its result: a contact under load that is pulled sideways by less than makes
// it slide.
Function shear_method();
template <>
const Class& class_of<PartialSlip>();

}  // namespace asperity::lua
