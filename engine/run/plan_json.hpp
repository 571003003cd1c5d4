// SPDX-License-Identifier: GPL-3.0-or-later
// A plan of a contact as JSON: the same struct that Plan::text() prints.
#pragma once

#include "engine/contact/plan.hpp"
#include "engine/core/files/json.hpp"

namespace asperity {

Json to_json(const Plan& plan);

}  // namespace asperity
