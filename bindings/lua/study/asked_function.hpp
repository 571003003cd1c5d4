// SPDX-License-Identifier: GPL-3.0-or-later
// The function `ask` of a budget or a sensitivity: called with a table of the quantities and knobs of a run,
// it gives one number; many runs go on side by side. And the uncertain inputs that such calls take.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/call_batch.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/part_monitor.hpp"
#include "engine/statistics/uncertain_input.hpp"
#include "engine/study/budget.hpp"
#include "engine/study/study_setting.hpp"

namespace asperity::lua {

// Warnings of what a study calls are shown; their progress is not, for the study has its own.
class QuietMonitor final : public Monitor {
 public:
  explicit QuietMonitor(Monitor& outer) : outer_(outer) {}
  void progress(std::string_view, double) override {}
  void warn(std::string_view sentence) override { outer_.warn(sentence); }
  ResultStore* results() override { return outer_.results(); }

 private:
  Monitor& outer_;
};

// Leaves the function and a table of its knobs on the stack; `table` is what the error calls it where there
// is no memory for it.
void push_with_knobs(lua_State* L, const Argument& function, const Knobs& knobs, const char* table);

// Valid while the function stays where it is on the stack.
class AskedFunction {
 public:
  AskedFunction(const Call& call, const Argument& ask) : L_(call.L), ask_(ask), session_(call.session()) {}

  struct Answer {
    double value = 0;
    double seconds = 0;
  };
  // Throws Error with the function's own message and the knobs, and for an answer that is not one number.
  Answer operator()(const Knobs& knobs, Monitor& monitor) const;
  // What a dry run asks: an answer that cannot be known is no mistake.
  void try_once(const Knobs& knobs) const;

 private:
  void call(const Knobs& knobs) const;

  lua_State* L_;
  Argument ask_;
  Session& session_;
};

// The same function for many runs. The first batch goes one by one in the script's own state; if it made a
// heavy call, those behind it are spread over threads, where what one call changes is seen by no other. Each
// call has one thread then, so that their times can be compared.
class AskedRuns {
 public:
  AskedRuns(const Call& call, const Argument& ask);

  // `done` is told how many there are of this batch, and of one that goes on by itself its share. Throws as
  // AskedFunction does, for the first that fails.
  std::vector<AskedFunction::Answer> operator()(const std::vector<Knobs>& runs,
                                                const std::function<void(double)>& done);
  // Calls that go on side by side where calls are heavy.
  int at_a_time() const { return batch_ != nullptr ? thread_count() : 1; }

 private:
  AskedFunction ask_;
  Session& session_;
  std::unique_ptr<CallBatch> batch_;
  bool begun_ = false, heavy_ = false;
};

// Runs of unknown length as one progress.
class RunProgress {
 public:
  RunProgress(Monitor& monitor, std::string title) : monitor_(monitor), title_(std::move(title)) {}
  // That `share` of the whole is done; `part` says what goes on.
  void report(const std::string& part, double share);

 private:
  Monitor& monitor_;
  std::string title_;
  PartMonitor::Clock::time_point begun_ = PartMonitor::Clock::now();
};

// What lists inputs; a dry run may meet some that it cannot know.
struct InputKeys {
  std::vector<UncertainInput> inputs;  // by name
  std::vector<InputCorrelation> correlations;
  bool unknown = false;
};
// `inputs={ hardness={ value="1.1 GPa", u="0.1 GPa", shape="normal" }, law=calibration }`.
void read_inputs(const Argument& value, const OptionInfo& info, InputKeys& keys, Problems& problems);

template <class O>
Option<O> inputs_option() {
  return custom<O>(
      "inputs", "table",
      "the uncertain quantities by name: { value=, u= }, with u the standard uncertainty in the same unit, "
      "or "
      "a share such as \"5 %\". shape=\"uniform\" lies anywhere within √3 u, \"triangular\" within √6 u; "
      "\"lognormal\" has mean `value` and deviation u; else it is normal, with degrees=n-1 if u comes from n "
      "readings (Student's t). { sample={…} } is a list of draws of the quantity itself. A calibration "
      "gives all its parameters, under their own names and with their correlation. `ask` gets each as a "
      "plain SI "
      "number",
      [](const Argument& value, const OptionInfo& info, O& keys, Problems& problems) {
        read_inputs(value, info, keys, problems);
      });
}

template <class O>
Option<O> ask_option(std::string sentence) {
  return custom<O>("ask", "function", std::move(sentence),
                   [](const Argument& value, const OptionInfo& info, O&, Problems& problems) {
                     if (!value.is_function()) detail::wrong_type(value, info, "a function(x)", problems);
                   })
      .required();
}

constexpr const char* knob_kinds = "a number, a string or a boolean";
// Nothing for other kinds. Sets `unknown` for the placeholder of a dry run.
std::optional<KnobValue> knob_value(const Argument& value, bool& unknown);
// A value, or a list of values.
void read_sweep(const std::string& name, const std::string& path, const Argument& value, bool& unknown,
                std::vector<KnobSweep>& knobs, Problems& problems);

// Knobs in the order that Knobs has.
void sort_knobs(Knobs& knobs);

}  // namespace asperity::lua
