// SPDX-License-Identifier: GPL-3.0-or-later
// The function `ask` of a budget or a sensitivity, from a table of inputs and knobs to one number.
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
#include "engine/statistics/uncertain_input.hpp"
#include "engine/study/budget.hpp"
#include "engine/study/study_setting.hpp"

namespace asperity::lua {

Map knobs_map(const Knobs& knobs);
// `table` names the table in an out-of-memory error.
void push_with_knobs(lua_State* L, const Argument& function, const Knobs& knobs, const char* table);

// Valid while the function keeps its stack index.
class AskedFunction {
 public:
  AskedFunction(const Call& call, const Argument& ask) : L_(call.L), ask_(ask), session_(call.session()) {}

  struct Answer {
    double value = 0;
    double seconds = 0;
  };
  // Throws Error for a failure (with the knobs) and for an answer other than one number.
  Answer operator()(const Knobs& knobs, Monitor& monitor) const;
  // For a dry run: accepts an unknown answer.
  void try_once(const Knobs& knobs) const;

 private:
  void call(const Knobs& knobs) const;

  lua_State* L_;
  Argument ask_;
  Session& session_;
};

// Many runs. The first batch is serial in the script's state. After a heavy call, later batches use threads:
// each call sees only its own changes and has one thread, for comparable times.
class AskedRuns {
 public:
  AskedRuns(const Call& call, const Argument& ask);

  // `done`: finished runs of the batch, with the share of a serial run. Throws as AskedFunction for the first
  // failure.
  std::vector<AskedFunction::Answer> operator()(const std::vector<Knobs>& runs,
                                                const std::function<void(double)>& done);
  int at_a_time() const { return batch_ != nullptr ? thread_count() : 1; }

 private:
  AskedFunction ask_;
  Session& session_;
  std::unique_ptr<CallBatch> batch_;
  bool begun_ = false, heavy_ = false;
};

class RunProgress {
 public:
  RunProgress(Monitor& monitor, std::string title) : monitor_(monitor), title_(std::move(title)) {}
  // `share` is the finished share; `part` the current part.
  void report(const std::string& part, double share);

 private:
  Monitor& monitor_;
  std::string title_;
  PartMonitor::Clock::time_point begun_ = PartMonitor::Clock::now();
};

struct InputKeys {
  std::vector<UncertainInput> inputs;  // by name
  std::vector<InputCorrelation> correlations;
  bool unknown = false;
};
// inputs={ hardness={ value="1.1 GPa", u="0.1 GPa", shape="normal" }, law=calibration }
void read_inputs(const Argument& value, const OptionInfo& info, InputKeys& keys, Problems& problems);

template <class O>
Option<O> inputs_option(InputKeys O::*member) {
  return custom("inputs", "table",
                "the uncertain quantities by name: { value=, u= }, with u the standard uncertainty in the "
                "same unit, or a share such as \"5 %\". shape=\"uniform\" lies anywhere within √3 u, "
                "\"triangular\" within √6 u; \"lognormal\" has mean `value` and deviation u; else it is "
                "normal, with degrees=n-1 if u comes from n readings (Student's t). { sample={…} } is a "
                "list of draws of the quantity itself. A calibration gives all its parameters, under "
                "their own names and with their correlation. `ask` gets each as a plain SI number",
                member, read_inputs);
}

constexpr const char* knob_kinds = "a number, a string or a boolean";
// Empty for other kinds. Sets `unknown` for a placeholder.
std::optional<KnobValue> knob_value(const Argument& value, bool& unknown);
// A value or a list.
void read_sweep(const std::string& name, const std::string& path, const Argument& value, bool& unknown,
                std::vector<KnobSweep>& knobs, Problems& problems);

// By name.
void sort_knobs(Knobs& knobs);

}  // namespace asperity::lua
