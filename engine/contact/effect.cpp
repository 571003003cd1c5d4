// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effect.hpp"

#include <algorithm>

namespace asperity {

void Effects::set(const Effect& effect, std::any options) {
  const auto known = std::ranges::find(named_, &effect, &Named::effect);
  if (known != named_.end())
    known->options = std::move(options);
  else
    named_.push_back({&effect, std::move(options)});
}

const std::any* Effects::options_of(const Effect& effect) const {
  const auto known = std::ranges::find(named_, &effect, &Named::effect);
  return known == named_.end() ? nullptr : &known->options;
}

bool Effects::names(std::string_view effect) const {
  return std::ranges::any_of(named_, [&](const Named& named) { return named.effect->name == effect; });
}

bool Effects::any_that(Effect::Acts acts) const {
  return std::ranges::any_of(named_, [&](const Named& named) { return named.effect->acts == acts; });
}

Effects Effects::of_solve() const {
  Effects result = *this;
  std::erase_if(result.named_,
                [](const Named& named) { return named.effect->acts == Effect::Acts::reads_state; });
  return result;
}

}  // namespace asperity
