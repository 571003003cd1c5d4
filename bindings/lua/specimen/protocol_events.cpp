// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

const std::vector<OptionInfo>& infos() {
  static const std::vector<OptionInfo> all = {
      {"press", "table", {}, "", "", "puts a load on, as c:press does", false, &press_block},
      {"release", "boolean", {}, "", "", "true: takes it off"},
      {"place",
       "table",
       {},
       "",
       "",
       "lifts the upper body and puts it down afresh, as c:place does",
       false,
       &place_block},
      {"rotate", "an angle", dimension::angle, "", "", "turns the upper body by an angle, as c:rotate does"},
      {"shift", "table", {}, "", "", "shifts the upper body, as c:shift does", false, &shift_block}};
  return all;
}

std::vector<std::string> event_names() {
  std::vector<std::string> names;
  for (const OptionInfo& info : infos()) names.push_back(info.name);
  return names;
}

class EventReader {
 public:
  std::optional<Protocol> read(const Argument& list, const std::string& caller) {
    if (!list.is_table())
      refuse(caller + " takes a list of events, and was given " + list.describe(),
             "write " + caller + "{ { press={ pressure=\"10 MPa\" } }, { release=true } }");
    look_for_stray_keys(list);
    for (std::int64_t k = 1; k <= list.length(); ++k) {
      event_ = "event " + std::to_string(k) + ": ";
      list.element(k, [&](const Argument& event) { read_event(event); });
    }
    fail_if_any(caller);
    if (placeholders_) return {};
    return Protocol(std::move(events_));
  }

 private:
  void problem(const std::string& text) {
    std::string indented = event_;
    for (const char c : text) indented += c == '\n' ? std::string("\n  ") : std::string(1, c);
    problems_.push_back(std::move(indented));
  }

  void fail_if_any(const std::string& caller) const {
    if (problems_.empty()) return;
    if (problems_.size() == 1) refuse(caller + ": " + problems_.front());
    constexpr std::size_t enough = 20;
    std::string sentence = caller + ": " + std::to_string(problems_.size()) + " problems";
    for (std::size_t k = 0; k < std::min(enough, problems_.size()); ++k) sentence += "\n  " + problems_[k];
    if (problems_.size() > enough)
      sentence += "\n  and " + std::to_string(problems_.size() - enough) + " more";
    refuse(sentence);
  }

  void look_for_stray_keys(const Argument& list) {
    const std::vector<std::string> names = event_names();
    std::vector<std::string> found;
    list.each([&](const Argument& key, const Argument&) {
      if (key.is_text()) {
        const std::string name(key.text().substr(0, 40));
        const bool known = std::find(names.begin(), names.end(), name) != names.end();
        found.push_back(known ? "`" + name + "` is outside the braces of an event; write { " + name + "=... }"
                              : "unknown key " + quoted(name) + "; a protocol is a list of events");
      } else if (const auto n = key.is_number() ? key.integer() : std::nullopt;
                 !n || *n < 1 || *n > list.length()) {
        found.push_back("the list has an entry at " + key.describe() + "; number events from 1 without gaps");
      }
    });
    std::sort(found.begin(), found.end());
    problems_ = std::move(found);
  }

  void read_event(const Argument& event) {
    if (event.is_unknown()) {
      placeholders_ = true;
      return;
    }
    if (!event.is_table())
      return problem("it is " + event.describe() + "; give a table such as { release=true }");
    const std::string name = only_key(event);
    if (name.empty()) return;
    with_key(event, name, [&](const Argument& value) {
      if (value.is_unknown()) {
        placeholders_ = true;
      } else {
        try {
          read_step(name, value);
        } catch (const Error& error) {
          problem(error.what());
        }
      }
    });
  }

  // "" after a problem.
  std::string only_key(const Argument& event) {
    const std::vector<std::string> names = event_names();
    std::vector<std::string> known, unknown;
    bool unnamed = false;
    event.each([&](const Argument& key, const Argument&) {
      if (!key.is_text())
        unnamed = true;
      else if (std::find(names.begin(), names.end(), key.text()) != names.end())
        known.emplace_back(key.text());
      else
        unknown.emplace_back(key.text().substr(0, 40));
    });
    std::sort(known.begin(), known.end());
    std::sort(unknown.begin(), unknown.end());
    if (unnamed) problem("it holds a value without a key; write { press={ pressure=\"10 MPa\" } }");
    for (const std::string& name : unknown) problem(stranger(name, known));
    if (known.size() > 1) problem("it holds " + joined(known, " and ") + "; give each braces of its own");
    if (known.empty() && unknown.empty() && !unnamed)
      problem("it is empty; the events are " + joined(names, " and "));
    return known.size() == 1 && unknown.empty() && !unnamed ? known.front() : std::string();
  }

  // It may belong inside the event's own table.
  static std::string stranger(const std::string& name, const std::vector<std::string>& known) {
    for (const OptionInfo& info : infos()) {
      if (info.inner == nullptr) continue;
      if (!known.empty() && std::find(known.begin(), known.end(), info.name) == known.end()) continue;
      for (const OptionInfo* option : info.inner->options())
        if (option->name == name)
          return quoted(name) + " belongs inside: { " + info.name + "={ " + name + "=... } }";
    }
    const std::vector<std::string> names = event_names();
    return "unknown event " + quoted(name) + did_you_mean(name, names) + "; the events are " +
           joined(names, " and ");
  }

  void read_step(const std::string& name, const Argument& value) {
    if (name == "press") {
      read_table(press_block, name, value, [](const PressKeys& keys) { return PressRequest(keys); });
    } else if (name == "place") {
      read_table(place_block, name, value, [](const PlaceKeys& keys) { return Protocol::Place{keys.seed}; });
    } else if (name == "shift") {
      read_table(shift_block, name, value, [](const ShiftKeys& keys) {
        return Protocol::Shift{keys.x, keys.y};
      });
    } else if (name == "rotate") {
      Problems found;
      const auto angle = detail::read_quantity(value, infos()[3], any(), found);
      for (const std::string& text : found) problem(text);
      if (angle) events_.push_back({Protocol::Rotate{*angle}});
    } else if (!value.is_boolean() || !value.boolean()) {
      problem("`release` is " + (value.is_boolean() ? std::string("false") : value.describe()) +
              "; write { release=true }");
    } else {
      events_.push_back({Protocol::Release{}});
    }
  }

  template <class Keys, class Make>
  void read_table(const Block<Keys>& block, const std::string& name, const Argument& value, Make make) {
    if (!value.is_table())
      return problem(quoted(name) + " is " + value.describe() + "; give a table of named keys, as c:" + name +
                     " takes");
    const Keys keys = block.read(value, name);
    bool known = true;
    value.each([&](const Argument&, const Argument& item) { known = known && !item.is_unknown(); });
    if (known)
      events_.push_back({make(keys)});
    else
      placeholders_ = true;
  }

  std::string event_;
  std::vector<Protocol::Event> events_;
  std::vector<std::string> problems_;
  bool placeholders_ = false;
};

class ProtocolKeys final : public BlockInfo {
 public:
  std::vector<const OptionInfo*> options() const override { return pointers_to(infos()); }
  bool is_list() const override { return true; }
  void check(const Argument& list, const std::string& caller) const override { read_protocol(list, caller); }
};

}  // namespace

std::optional<Protocol> read_protocol(const Argument& list, const std::string& caller) {
  return EventReader().read(list, caller);
}

const BlockInfo& protocol_keys() {
  static const ProtocolKeys keys;
  return keys;
}

}  // namespace asperity::lua
