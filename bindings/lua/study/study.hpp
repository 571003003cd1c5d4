// SPDX-License-Identifier: GPL-3.0-or-later
// What lab.work_precision returns, a study and a setting that it chose; and how a study is kept in the run
// directory.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "bindings/lua/registry/registry.hpp"
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

}  // namespace asperity::lua
