// SPDX-License-Identifier: GPL-3.0-or-later
// lab.contact, and contacts as native values.
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

// Options of c:press, c:place and c:shift, also in protocol events.
struct PressKeys {
  int given = 0;  // number of given controls; exactly one is allowed
  PressRequest request;
  std::optional<double> dwell;
  std::vector<double> preload;
};
const Block<PressKeys>& press_block();
// The presses of c:press or c:sweep; empty for other functions and values unknown in a dry run. Throws like
// the call.
std::vector<PressRequest> requests_of(const Call& call, const Function& function);
// For a press by an iterator; equal to the line of c:press.
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

// contact:shear (shear.cpp): partial slip under a tangential force below sliding.
Function shear_method();
template <>
const Class& class_of<PartialSlip>();

}  // namespace asperity::lua
