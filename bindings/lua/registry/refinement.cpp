// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

std::int64_t Refinement::cells(std::int64_t given) {
  grids.fetch_add(1);
  if (cells_factor == 1) return given;
  return std::max<std::int64_t>(1, std::llround(static_cast<double>(given) * cells_factor));
}

double Refinement::tolerance_for(double given) {
  contacts.fetch_add(1);
  double known = tightest.load();
  while (given < known && !tightest.compare_exchange_weak(known, given)) {
  }
  return tolerance.value_or(given);
}

Refinement* refinement_of(lua_State* L) {
  const Session* session = Session::find(L);
  return session == nullptr ? nullptr : session->refinement.get();
}

}  // namespace asperity::lua
