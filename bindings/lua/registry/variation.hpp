// SPDX-License-Identifier: GPL-3.0-or-later
// How `asperity replay --set key=value` runs a recorded script with another number in it without changing its
// text: where a call gives the key, the value is replaced while the call's options are read, so that it is
// checked like any other and stands in the new run's record. `press.pressure=...` is about calls of that name
// alone, and gives them the key where the script leaves it out.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/lua_api.hpp"

namespace asperity::lua {

// Shared by the states of a run and of its ensembles' cases. Thread-safe after it was filled.
class Variation {
 public:
  // "pressure=200 MPa" or "press.pressure=200 MPa". Throws Error{bad_value} for a text without `=` or key.
  void set(const std::string& text);
  bool empty() const { return settings_.empty(); }
  // Calls made while this says no are left as they are; asked from any thread.
  std::function<bool()> in_force = [] { return true; };

  // Called where the options of a call are read: whether `key` is to be set anew, given by the script or not;
  // the new value is then on the stack of `L`, which must have room for it. Not the keys of a knob, whose
  // value is the recorded one. Raises no Lua error.
  bool replaces(lua_State* L, std::string_view caller, std::string_view key, bool given);
  // Called where a value that was set anew is none that the key takes: what happened then is no difference
  // between two runs.
  void note_refused(std::string_view caller, std::string_view key, const std::string& problem);
  // Throws Error{bad_value} for a value that a call refused, Error{unknown_name} for a setting that no call
  // met, naming the nearest key that one gave.
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
  std::string refused_;       // the first value that a call refused, and why; empty: none
  mutable std::mutex mutex_;  // of what was met
  std::map<std::string, std::set<std::string>, std::less<>>
      keys_;  // that were given, and the calls that gave them
  std::set<std::string, std::less<>> keys_of_knobs_;
};

// That of the state's session; null where there is none.
Variation* variation_of(lua_State* L);

}  // namespace asperity::lua
