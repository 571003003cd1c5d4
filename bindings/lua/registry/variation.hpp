// SPDX-License-Identifier: GPL-3.0-or-later
// Changed values for `asperity replay --set key=value`. The value replaces the key while a call's options are
// read; it is checked and recorded like any other. `press.pressure=...` applies only to calls of this name,
// and also sets an omitted key.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Shared by a run and its cases. Thread-safe after the last set().
class Variation {
 public:
  // Throws Error{bad_value} without `=` or key.
  void set(const std::string& text);
  bool empty() const { return settings_.empty(); }
  // While false, calls keep their values. Called from any thread.
  std::function<bool()> in_force = [] { return true; };

  // If `key` has a new value, pushes it on `L`, which must have room, and returns true. `given`: in the
  // script. Knobs keep their recorded values. Raises no Lua error.
  bool replaces(lua_State* L, std::string_view caller, std::string_view key, bool given);
  // For a new value that the call refused.
  void note_refused(std::string_view caller, std::string_view key, const std::string& problem);
  // Throws Error{bad_value} for a refused value, and Error{unknown_name} with the nearest key for a setting
  // without matching call.
  void check_all_met() const;
  // "pressure = 200 MPa and seed = 7"
  std::string text() const;

 private:
  struct Setting {
    std::string caller;  // "press"; empty: any
    std::string key, value;
    bool met = false;
  };
  std::vector<Setting> settings_;
  std::string refused_;  // with the reason; "": none
  mutable std::mutex mutex_;
  std::map<std::string, std::set<std::string>, std::less<>> keys_;  // in the script, with calls
  std::set<std::string, std::less<>> keys_of_knobs_;
};

Variation* variation_of(lua_State* L);

// Grid refinement for `asperity accuracy`: `cells` are multiplied by a factor and rounded, at least 1, and
// the tolerances of contacts replaced. Surfaces from files and tables keep their cells. Counters show which
// quantities can vary.

// Shared by a run and its cases. Thread-safe.
struct Refinement {
  double cells_factor = 1;
  std::optional<double> tolerance;

  // Counts, and the script's smallest tolerance.
  std::atomic<std::int64_t> grids{0};
  std::atomic<std::int64_t> contacts{0};
  std::atomic<double> tightest{std::numeric_limits<double>::infinity()};

  // Effective value; updates the counters.
  std::int64_t cells(std::int64_t given);
  double tolerance_for(double given);
};

Refinement* refinement_of(lua_State* L);

}  // namespace asperity::lua
