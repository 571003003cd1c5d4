// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene/effect.hpp"

#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

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

std::string effects_that(Effect::Acts acts) {
  std::vector<std::string> names = effect_names(acts);
  for (std::string& name : names) name = quoted(name);
  return joined(names);
}

void refuse_without(const std::string& what, const std::string& quoted_effect, std::string hint) {
  refuse_state(what + " needs the effect " + quoted_effect + ", which this scene does not name",
               std::move(hint));
}

}  // namespace asperity
