// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of the bodies after an event, in their own frames: heights and BodyMemory. Each effect of the
// scene adds its changes in turn (Effect::leave).
#pragma once

#include <optional>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/planned_yield.hpp"

namespace asperity {

struct AfterEvent {
  const ContactGeometry& geometry;  // during the event
  Surface lower;
  UpperBody upper;
  BodyMemory memory;
  // m, from both bodies, at the lower body's nodes; none: heights unchanged.
  std::optional<Field> yielded{};
  // Mapped over intended volume of the upper body, before rescaling.
  double mapped_volume = 1;
  std::optional<CarriedLoad> carried{};
  bool changed = false;

  explicit AfterEvent(const ContactGeometry& during)
      : geometry(during), lower(during.lower()), upper(during.upper()), memory(during.memory()) {}
};

}  // namespace asperity
