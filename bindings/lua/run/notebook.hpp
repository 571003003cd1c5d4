// SPDX-License-Identifier: GPL-3.0-or-later
// lab.notebook: rows with free columns, expectations and charts.
#pragma once

#include "bindings/lua/registry/registry.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/notebook_chart.hpp"

namespace asperity::lua {

template <>
const Class& class_of<Notebook>();

Function notebook_function();
const Block<NotebookChart>& notebook_chart_block();

}  // namespace asperity::lua
