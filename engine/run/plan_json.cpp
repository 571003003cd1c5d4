// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/plan_json.hpp"

namespace asperity {

Json to_json(const Plan& plan) {
  Json::List terms, buffers;
  for (const PlannedTerm& term : plan.terms)
    terms.push_back(Json::object({{"effect", term.effect}, {"sentence", term.sentence}}));
  for (const PlannedBuffer& buffer : plan.buffers)
    buffers.push_back(Json::object({{"name", buffer.name}, {"bytes", buffer.bytes}, {"kept", buffer.kept}}));
  return Json::object({{"contact", plan.title},
                       {"overlap_fraction", plan.overlap},
                       {"terms", terms},
                       {"solver", plan.solver},
                       {"tolerance", plan.accuracy.tolerance},
                       {"estimate", plan.estimate},
                       {"transforms", plan.transforms},
                       {"press", plan.press},
                       {"buffers", buffers},
                       {"bytes_kept", plan.bytes_kept()},
                       {"bytes_peak", plan.bytes_peak()},
                       {"bytes_to_flatten", plan.bytes_to_flatten},
                       {"seconds", plan.seconds},
                       {"warnings", Json::strings(plan.warnings)},
                       {"effects_run", Json::strings(plan.effects_run)},
                       {"effects_off", Json::strings(plan.effects_off)}});
}

}  // namespace asperity
