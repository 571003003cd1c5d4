// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/solution.hpp"

#include "engine/core/error.hpp"

namespace asperity {

ClosedSolution::ClosedSolution(const Solution& solution)
    : load_(solution.load()),
      pressure_(solution.pressure()),
      approach_(solution.approach()),
      attraction_(solution.attraction()),
      peak_pressure_(solution.peak_pressure()),
      preload_(solution.preload().begin(), solution.preload().end()),
      contacts_(solution.contacts()),
      yielded_(solution.yielded()),
      iterations_(solution.iterations()),
      solver_(solution.solver()) {}

void ClosedSolution::not_read(std::string_view what) {
  throw Error(ErrorCode::bad_state, std::string(what) + " was not read before the contact was closed",
              "read it before c:close(), or leave the contact open: Lua frees it with its last state");
}

}  // namespace asperity
