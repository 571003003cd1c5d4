// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of the room, and their results as native values: what lab.work_precision returns, a study and
// a setting that it chose, and how a study is kept in the run directory; and those of budgets, sensitivities
// and calibrations.
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

// A study that ran, complete or not.
struct Study {
  std::string name;
  StudyResult result;
};
// One of its settings.
struct StudyChoice {
  std::shared_ptr<const Study> study;
  std::size_t row;
  const StudyRow& found() const { return study->result.rows[row]; }
};

template <>
const Class& class_of<Study>();
template <>
const Class& class_of<StudyChoice>();

// The journal's lines of a study: what is asked, each call, and what came out; the rows also go to
// <name>.csv. Nothing is kept where there is no run.
void record_request(RunDirectory* run, const std::string& name, const StudyRequest& request);
void record_calls(RunDirectory* run, const std::string& name, std::span<const StudyRun> calls);
void record_result(RunDirectory* run, const std::string& name, const StudyResult& result);

// lab.work_precision: what a quantity costs to a given accuracy, by several ways over their settings.
Function work_precision_function();

// lab.budget: the whole error of a number, and what each part of it costs.
Function budget_function();
template <>
const Class& class_of<Budget>();

// lab.sensitivity: which uncertain input an answer hangs on, and which to measure better next.
Function sensitivity_function();
template <>
const Class& class_of<Sensitivity>();

// lab.calibrate: parameters of a model of the script fitted to the rows of a table.
Function calibrate_function();

}  // namespace asperity::lua
