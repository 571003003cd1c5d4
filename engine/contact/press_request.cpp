// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/press_request.hpp"

#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

std::string_view name(PressBy by) {
  switch (by) {
    case PressBy::pressure:
      return "pressure";
    case PressBy::load:
      return "load";
    case PressBy::approach:
      return "approach";
    case PressBy::indentation:
      return "indentation";
    case PressBy::flatten:
      return "flatten";
  }
  return {};
}

namespace {
std::string value_text(const PressRequest& request) {
  const char* unit = request.by == PressBy::pressure   ? " Pa"
                     : request.by == PressBy::load     ? " N"
                     : request.by == PressBy::approach ? " m"
                                                       : "";
  return quoted(name(request.by)) + " is " + format_short(request.value) + unit;
}
}  // namespace

void check(const PressRequest& request, bool attracts) {
  if (attracts && request.by == PressBy::flatten)
    throw Error(ErrorCode::bad_value, "`flatten` of bodies that attract each other is not computed",
                "press by `pressure`, `load`, `approach` or `indentation`");
  if (attracts && !std::isfinite(request.value))
    throw Error(ErrorCode::bad_value, value_text(request), "give a finite value; one below zero pulls");
  if (request.drawn_from && !attracts)
    throw Error(ErrorCode::bad_value, "`drawn_from` is given, and nothing attracts the bodies",
                "name `adhesion` or `capillarity`, or leave it out: without them a state has no history");
  if (request.drawn_from && !(*request.drawn_from >= request.value && std::isfinite(*request.drawn_from)))
    throw Error(ErrorCode::bad_value,
                "`drawn_from` is " + format_short(*request.drawn_from) + ", below the " +
                    quoted(name(request.by)) + " of " + format_short(request.value),
                "bodies are drawn back from a greater value");
  if (!attracts && !(request.value >= 0 && std::isfinite(request.value)))
    throw Error(ErrorCode::bad_value, value_text(request),
                "a contact without adhesion takes a finite value from zero up");
  if (request.by == PressBy::flatten && request.value > 1)
    throw Error(ErrorCode::bad_value, "`flatten` is " + format_short(request.value),
                "it is a fraction of the peak-to-valley: give a number from 0 to 1");
  if (request.dwell && !(*request.dwell >= 0))
    throw Error(ErrorCode::bad_value, "`dwell` is " + format_short(*request.dwell) + " s",
                "give a time from zero up");
}

}  // namespace asperity
