// SPDX-License-Identifier: GPL-3.0-or-later
// What an event leaves on the bodies, in their own frames: their heights, and what effects keep of each node
// beside them (BodyMemory). Each effect of the scene adds its own (Effect::leave), one after the other.
#pragma once

#include <optional>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/planned_yield.hpp"

namespace asperity {

struct AfterEvent {
  const ContactGeometry& geometry;  // the bodies during the event
  Surface lower;
  UpperBody upper;
  BodyMemory memory;
  // m at the nodes of the lower body, what both lost together; none: their heights are as they were.
  std::optional<Field> yielded{};
  // Of what the upper body lost: mapped off the lattice over meant, before it was scaled to be equal.
  double mapped_volume = 1;
  std::optional<CarriedLoad> carried{};
  bool changed = false;  // whether anything of the bodies is another than before

  explicit AfterEvent(const ContactGeometry& during)
      : geometry(during), lower(during.lower()), upper(during.upper()), memory(during.memory()) {}
};

}  // namespace asperity
