// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/variation.hpp"

#include <algorithm>
#include <cmath>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

// "press" matches "contact:press"; "lab.surface.sine" matches itself.
bool is_of(std::string_view caller, std::string_view wanted) {
  if (wanted.empty() || caller == wanted) return true;
  if (!caller.ends_with(wanted)) return false;
  const char before = caller[caller.size() - wanted.size() - 1];
  return before == '.' || before == ':';
}

// A number, true, false, otherwise a string without quotes.
void push_value(lua_State* L, const std::string& text) {
  if (text == "true" || text == "false") return lua_pushboolean(L, text == "true");
  if (lua_stringtonumber(L, text.c_str()) != 0) return;
  push_checked(L, text, "the value of `--set`");
}

}  // namespace

void Variation::set(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::size_t dot = name.find_last_of('.');
  Setting setting;
  if (dot != std::string::npos) setting.caller = name.substr(0, dot);
  setting.key = dot == std::string::npos ? name : name.substr(dot + 1);
  if (equals == std::string::npos || setting.key.empty())
    refuse("`--set` is " + quoted(text),
           "give a key and its value, as in --set pressure=\"200 MPa\" or --set press.dwell=\"1 min\"");
  setting.value = text.substr(equals + 1);
  if (setting.value.size() >= 2 && setting.value.front() == '"' && setting.value.back() == '"')
    setting.value = setting.value.substr(1, setting.value.size() - 2);
  settings_.push_back(std::move(setting));
}

bool Variation::replaces(lua_State* L, std::string_view caller, std::string_view key, bool given) {
  if (!in_force()) return false;
  const std::lock_guard lock(mutex_);
  if (caller == "lab.knob") {
    if (given) keys_of_knobs_.emplace(key);
    return false;
  }
  if (given) keys_[std::string(key)].emplace(caller);
  for (Setting& setting : settings_) {
    if (setting.key != key || !is_of(caller, setting.caller)) continue;
    if (!given && setting.caller.empty()) continue;
    setting.met = true;
    push_value(L, setting.value);
    return true;
  }
  return false;
}

void Variation::note_refused(std::string_view caller, std::string_view key, const std::string& problem) {
  const std::lock_guard lock(mutex_);
  if (!refused_.empty()) return;
  for (const Setting& setting : settings_)
    if (setting.key == key && is_of(caller, setting.caller)) {
      refused_ = "`--set` gives " + quoted(caller) + " the value \"" + setting.value + "\": " + problem;
      return;
    }
}

void Variation::check_all_met() const {
  const std::lock_guard lock(mutex_);
  if (!refused_.empty()) refuse(refused_, "give a value as the script would write it");
  for (const Setting& setting : settings_) {
    if (setting.met) continue;
    if (keys_of_knobs_.contains(setting.key) && !keys_.contains(setting.key))
      refuse("`--set` is of the key " + quoted(setting.key) +
                 ", which only a knob gives, and a replay takes knobs as recorded",
             "run its script with --knob NAME=VALUE");
    std::vector<std::string> meant, all;
    for (const auto& [key, callers] : keys_) {
      all.push_back(key);
      if (std::ranges::any_of(callers,
                              [&](const std::string& caller) { return is_of(caller, setting.caller); }))
        meant.push_back(key);
    }
    std::string sentence = "no call " + (setting.caller.empty() ? "" : "of " + quoted(setting.caller) + " ") +
                           "gives the key " + quoted(setting.key);
    if (const auto others = keys_.find(setting.key); others != keys_.end()) {
      std::vector<std::string> callers;
      for (const std::string& caller : others->second) callers.push_back(quoted(caller));
      sentence += ", which " + joined(callers, " and ") + (callers.size() == 1 ? " gives" : " give");
    } else {
      sentence += did_you_mean(setting.key, meant.empty() ? all : meant);
    }
    refuse_name(sentence, all.empty() ? "no call was made with keys"
                          : meant.empty() || setting.caller.empty()
                              ? "keys that were given: " + joined(all, " and ")
                              : "keys that it gives: " + joined(meant, " and "));
  }
}

std::string Variation::text() const {
  std::vector<std::string> parts;
  for (const Setting& setting : settings_)
    parts.push_back((setting.caller.empty() ? "" : setting.caller + ".") + setting.key + " = " +
                    setting.value);
  return joined(parts, " and ");
}

Variation* variation_of(lua_State* L) {
  const Session* session = Session::find(L);
  return session == nullptr ? nullptr : session->variation.get();
}

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
