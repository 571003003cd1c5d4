// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/yield_law.hpp"

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

bool YieldLaw::hardens() const { return std::isfinite(hardening) && (yield || std::isfinite(cap)); }

bool YieldLaw::caps() const { return !std::isfinite(hardening) && std::isfinite(cap); }

void check(const YieldLaw& law, int nx, int ny) {
  if (!(law.cap > 0))
    throw Error(ErrorCode::bad_value, "`hardness` is " + format_short(law.cap) + " Pa",
                "a hardness is a positive pressure, such as \"1.1 GPa\"");
  if (!(law.hardening > 0))
    throw Error(ErrorCode::bad_value, "`hardening` is " + format_short(law.hardening) + " Pa/m",
                "a hardening is positive, such as \"80 MPa/um\"; leave it out for a fixed hardness");
  if (!law.yield) return;
  if (!std::isfinite(law.hardening))
    throw Error(ErrorCode::bad_value, "a field of yield pressures came without `hardening`",
                "give `hardening`, or one `hardness` for all nodes");
  if (law.yield->nx() != nx || law.yield->ny() != ny)
    throw Error(ErrorCode::internal, "the yield pressures are not on the grid of the heights");
  const auto values = law.yield->values();
  const auto bad = std::find_if(values.begin(), values.end(), [](double y) { return !(y > 0); });
  if (bad != values.end())
    throw Error(ErrorCode::bad_value, "a yield pressure is " + format_short(*bad) + " Pa",
                "yield pressures are positive");
}

}  // namespace asperity
