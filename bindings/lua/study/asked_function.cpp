// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/study/asked_function.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

void push_asked(lua_State* s, bool v) { lua_pushboolean(s, v ? 1 : 0); }
void push_asked(lua_State* s, std::int64_t v) { lua_pushinteger(s, v); }
void push_asked(lua_State* s, double v) { lua_pushnumber(s, v); }
void push_asked(lua_State* s, const std::string& v) { lua_pushlstring(s, v.data(), v.size()); }

[[noreturn]] void no_number(const Argument& answer, const Knobs& knobs) {
  throw Error(ErrorCode::bad_value, "`ask` returned " + answer.describe() + " for " + lua_source(knobs),
              "return one number");
}

// A number or a text with a unit; nothing, and a problem, for anything else.
std::optional<Quantity> quantity_of(const Argument& value, const std::string& path, Problems& problems) {
  if (value.is_number()) return Quantity{value.number(), dimension::number};
  if (value.is_text()) {
    try {
      return parse_quantity(value.text());
    } catch (const Error& error) {
      problems.push_back(quoted(path) + ": " + error.what());
      return {};
    }
  }
  problems.push_back(quoted(path) + (value.is_nil() ? " is missing" : " is " + value.describe()) +
                     "; give a number or a quantity such as \"1.1 GPa\"");
  return {};
}

void read_input(const std::string& name, const std::string& path, const Argument& table, InputKeys& keys,
                Problems& problems) {
  if (!table.is_table()) {
    problems.push_back(quoted(path) + " is " + table.describe() +
                       "; give { value=, u= }, such as { value=\"1.1 GPa\", u=\"0.1 GPa\" }");
    return;
  }
  UncertainInput input;
  input.name = name;
  bool unknown = false;
  std::optional<Quantity> value, u;
  const std::size_t before = problems.size();
  table.each([&](const Argument& key, const Argument& given) {
    static const std::vector<std::string> names = {"value", "u", "shape"};
    if (!key.is_text() || std::ranges::find(names, key.text()) == names.end()) {
      const std::string known = key.is_text() ? did_you_mean(key.text(), names) : "";
      problems.push_back(quoted(path) + " has no key " +
                         (key.is_text() ? quoted(key.text()) : key.describe()) + known +
                         "; it takes `value`, `u` and `shape`");
    } else if (given.is_unknown()) {
      unknown = true;
    } else if (key.text() == "shape") {
      if (given.is_text() && given.text() == "uniform")
        input.shape = InputShape::uniform;
      else if (!given.is_text() || given.text() != "normal")
        problems.push_back(quoted(path + ".shape") + " is " + given.describe() +
                           "; give \"normal\" or \"uniform\"");
    } else {
      auto read = quantity_of(given, path + "." + std::string(key.text()), problems);
      if (key.text() == "u" && given.is_text() && given.text().find('%') != std::string_view::npos && read) {
        // A share of the value, which may not be read yet.
        with_key(table, "value", [&](const Argument& of) {
          Problems ignored;
          if (const auto whole = quantity_of(of, path, ignored))
            read = Quantity{std::abs(whole->value) * read->value, whole->dimension};
        });
      }
      (key.text() == "u" ? u : value) = read;
    }
  });
  if (unknown) {
    keys.unknown = true;
    return;
  }
  if (problems.size() > before) return;
  for (const auto& [key, read] : {std::pair("value", value), std::pair("u", u)})
    if (!read)
      problems.push_back(quoted(path) + " has no " + quoted(key) +
                         "; give { value=, u= }, such as { value=\"1.1 GPa\", u=\"0.1 GPa\" }");
  if (!value || !u) return;
  if (!(value->dimension == u->dimension)) {
    problems.push_back(quoted(path) + " has a value that is " + describe(value->dimension) +
                       " and an uncertainty that is " + describe(u->dimension) +
                       "; give both in units of one kind");
    return;
  }
  input.value = value->value;
  input.uncertainty = u->value;
  keys.inputs.push_back(std::move(input));
}

// The share of a run that is done, of which it may speak several times over and which never falls.
class ShareMonitor final : public Monitor {
 public:
  ShareMonitor(Monitor& outer, std::function<void(double)> tell) : outer_(outer), tell_(std::move(tell)) {}
  void progress(std::string_view, double done) override {
    if (done > furthest_) tell_(furthest_ = std::min(done, 1.0));
  }
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  void inform(std::string_view sentence) override { outer_.inform(sentence); }
  ResultStore* results() override { return outer_.results(); }

 private:
  Monitor& outer_;
  std::function<void(double)> tell_;
  double furthest_ = 0;
};

}  // namespace

void push_with_knobs(lua_State* L, const Argument& function, const Knobs& knobs, const char* table) {
  if (lua_checkstack(L, 8) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
  lua_pushvalue(L, function.index());
  auto fill = [&knobs](lua_State* s) {
    lua_createtable(s, 0, static_cast<int>(knobs.size()));
    for (const Knob& knob : knobs) {
      lua_pushlstring(s, knob.name.data(), knob.name.size());
      std::visit([s](const auto& v) { push_asked(s, v); }, knob.value);
      lua_rawset(s, -3);
    }
    return 2;
  };
  if (protect(L, 1, 2, fill) != LUA_OK)
    throw Error(ErrorCode::out_of_memory, std::string("there is no memory for ") + table);
}

void AskedFunction::call(const Knobs& knobs) const {
  push_with_knobs(L_, ask_, knobs, "the table of `ask`");
  if (lua_pcall(L_, 1, 1, 0) == LUA_OK) return;
  stop_flag().check();
  throw Error(ErrorCode::bad_value,
              "`ask` failed for " + lua_source(knobs) + ": " + std::string(error_text(L_, -1)));
}

AskedFunction::Answer AskedFunction::operator()(const Knobs& knobs, Monitor& monitor) const {
  stop_flag().check();
  const Argument::StackGuard guard(L_);
  const Session::Reporting reporting(session_, monitor);
  const auto begun = std::chrono::steady_clock::now();
  call(knobs);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  const Argument answer(L_, -1);
  if (!answer.is_number()) no_number(answer, knobs);
  return {answer.number(), took.count()};
}

void AskedFunction::try_once(const Knobs& knobs) const {
  const Argument::StackGuard guard(L_);
  call(knobs);
  const Argument answer(L_, -1);
  if (!answer.is_number() && !answer.is_unknown()) no_number(answer, knobs);
}

AskedRuns::AskedRuns(const Call& call, const Argument& ask)
    : ask_(call, ask), session_(call.session()), batch_(call_batch(call, ask, "ask")) {}

std::vector<AskedFunction::Answer> AskedRuns::operator()(const std::vector<Knobs>& runs,
                                                         const std::function<void(double)>& done) {
  std::vector<AskedFunction::Answer> found;
  if (!heavy_) {
    std::optional<SingleThreaded> alone;
    if (batch_ != nullptr && !begun_) alone.emplace();
    const std::int64_t before = session_.heavy_calls;
    for (const Knobs& knobs : runs) {
      ShareMonitor monitor(session_.monitor(),
                           [&](double share) { done(static_cast<double>(found.size()) + share); });
      found.push_back(ask_(knobs, monitor));
      done(static_cast<double>(found.size()));
    }
    heavy_ = batch_ != nullptr && !begun_ && session_.heavy_calls > before;
    begun_ = true;
    return found;
  }
  std::vector<Values> arguments;
  for (const Knobs& knobs : runs) {
    Map x;
    for (const Knob& knob : knobs)
      std::visit([&](const auto& value) { x.items.emplace_back(knob.name, Value(value)); }, knob.value);
    arguments.push_back({Value(std::move(x))});
  }
  QuietMonitor quiet(session_.monitor());
  const Session::Reporting reporting(session_, quiet);
  const std::vector<BatchedAnswer> answers =
      batch_->answers(arguments, [&done](std::size_t count) { done(static_cast<double>(count)); });
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const BatchedAnswer& answer = answers[k];
    if (!answer.failure.empty())
      throw Error(ErrorCode::bad_value,
                  "`ask` failed for " + lua_source(runs[k]) + ": " + without_traceback(answer.failure));
    if (!answer.number)
      throw Error(ErrorCode::bad_value, "`ask` returned " + answer.other + " for " + lua_source(runs[k]),
                  "return one number");
    found.push_back({*answer.number, answer.seconds});
  }
  return found;
}

void RunProgress::report(const std::string& part, double share) {
  const std::chrono::duration<double> since = PartMonitor::Clock::now() - begun_;
  monitor_.progress_of_parts(title_, share, part, since.count());
}

void read_inputs(const Argument& value, const OptionInfo& info, InputKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info,
                              "a table such as { hardness={ value=\"1.1 GPa\", u=\"0.1 GPa\" } }", problems);
  value.each([&](const Argument& key, const Argument& input) {
    if (!key.is_text())
      problems.push_back(quoted(info.name) +
                         " has an entry without a name; write `hardness = { value=, u= }`");
    else if (input.is_unknown())
      keys.unknown = true;
    else
      read_input(std::string(key.text()), info.name + "." + std::string(key.text()), input, keys, problems);
  });
  // Lua keeps no order.
  std::ranges::sort(keys.inputs, {}, &UncertainInput::name);
}

void sort_knobs(Knobs& knobs) { std::ranges::sort(knobs, {}, &Knob::name); }

}  // namespace asperity::lua
