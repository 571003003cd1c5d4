// SPDX-License-Identifier: GPL-3.0-or-later
// lab.work_precision, budget, sensitivity and calibrate: functions, results as Lua values, records.
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

// Journal lines of a study; the rows also go to <name>.csv. Without a run they do nothing.
void record_request(RunDirectory* run, const std::string& name, const StudyRequest& request);
void record_calls(RunDirectory* run, const std::string& name, std::span<const StudyRun> calls);
void record_result(RunDirectory* run, const std::string& name, const StudyResult& result);

// Cost against accuracy, by several ways.
Function work_precision_function();

// Total error of a number, and what it costs to halve each part.
Function budget_function();
template <>
const Class& class_of<Budget>();

// Shares of uncertain inputs in the variance of an answer.
Function sensitivity_function();
template <>
const Class& class_of<Sensitivity>();

// Fit of a Lua model to a table.
Function calibrate_function();

}  // namespace asperity::lua
