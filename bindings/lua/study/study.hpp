// SPDX-License-Identifier: GPL-3.0-or-later
// lab.work_precision, lab.budget, lab.sensitivity and lab.calibrate, their results as native values, and the
// records of a study in the run directory.
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

template <>
const Class& class_of<Study>();
template <>
const Class& class_of<StudyChoice>();

// Write the journal's lines of a study: request, calls, result. The rows also go to <name>.csv. Without a run
// nothing is written.
void record_request(RunDirectory* run, const std::string& name, const StudyRequest& request);
void record_calls(RunDirectory* run, const std::string& name, std::span<const StudyRun> calls);
void record_result(RunDirectory* run, const std::string& name, const StudyResult& result);

// Cost of a quantity for a given accuracy, by several ways over their settings.
Function work_precision_function();

// Total error of a number, and the cost of halving each part.
Function budget_function();
template <>
const Class& class_of<Budget>();

// Shares of the uncertain inputs in the variance of an answer, and the input to measure next.
Function sensitivity_function();
template <>
const Class& class_of<Sensitivity>();

// Fits parameters of a Lua model to the rows of a table.
Function calibrate_function();

}  // namespace asperity::lua
