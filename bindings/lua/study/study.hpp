// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/run/calibration.hpp"
#include "engine/study/budget.hpp"
#include "engine/study/sensitivity.hpp"
#include "engine/study/work_precision.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::lua {

// Finished or interrupted.
struct Study {
  std::string name;
  StudyResult result;
};
struct StudyChoice {
  std::shared_ptr<const Study> study;
  std::size_t row;
  const StudyRow& found() const { return study->result.rows[row]; }
};

Class make_class(For<Study>);
Class make_class(For<StudyChoice>);

// Journal lines of a study; rows also in <name>.csv. Nothing without a run.
void record_request(RunDirectory* run, const std::string& name, const StudyRequest& request);
void record_calls(RunDirectory* run, const std::string& name, std::span<const StudyRun> calls);
void record_result(RunDirectory* run, const std::string& name, const StudyResult& result);

Function work_precision_function();

Function budget_function();
Class make_class(For<Budget>);

Function sensitivity_function();
Class make_class(For<Sensitivity>);

Function calibrate_function();

}  // namespace asperity::lua
