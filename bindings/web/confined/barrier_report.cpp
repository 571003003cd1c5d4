// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/barrier_report.hpp"

#include <algorithm>

#include "bindings/web/confined/confined_process.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr std::size_t ways_out = 4;

const Json& report_member(const Json& json, const char* name) {
  const Json* found = json.find(name);
  if (found == nullptr)
    throw Error(ErrorCode::internal, "the trial of the barriers says nothing of " + asperity::quoted(name));
  return *found;
}

}  // namespace

bool BarrierReport::all_hold() const {
  return tried.size() == ways_out && std::ranges::all_of(tried, &Barrier::holds);
}

std::string BarrierReport::text() const {
  std::string text;
  for (const Barrier& barrier : tried)
    text += "  " + barrier.name + std::string(barrier.name.size() < 11 ? 11 - barrier.name.size() : 1, ' ') +
            (barrier.holds ? barrier.sentence : "NOT SHUT: " + barrier.by) + "\n";
  if (tried.size() < ways_out)
    text += "  NOT SHUT: " + (problem.empty() ? std::string("another program could be run") : problem) + "\n";
  text += "  by " + joined(made, ", ") + "\n";
  if (!missing.empty()) text += "  without " + joined(missing, ", ") + "\n";
  return text;
}

BarrierReport try_out_barriers(const std::string& folder) {
  BarrierReport report;
  try {
    ConfinedRequest request{.work = Work::probe, .confinement = {}};
    const Finished done = run_confined(request, folder, std::chrono::seconds(5), std::size_t{1} << 16);
    // The last line holds all results.
    const std::size_t end = done.output.rfind('\n');
    if (end == std::string::npos) {
      report.problem = done.error.empty() ? "the trial said nothing" : done.error;
      return report;
    }
    const std::size_t before = end == 0 ? std::string::npos : done.output.rfind('\n', end - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const Json json = Json::parse(done.output.substr(begin, end - begin), "the trial of the barriers");
    for (const Json& name : report_member(json, "made").list()) report.made.push_back(name.string());
    for (const Json& name : report_member(json, "missing").list()) report.missing.push_back(name.string());
    for (const Json& barrier : report_member(json, "barriers").list())
      report.tried.push_back(
          {report_member(barrier, "name").string(), report_member(barrier, "sentence").string(),
           report_member(barrier, "holds").boolean(), report_member(barrier, "by").string()});
  } catch (const Error& error) {
    report.problem = error.what();
  }
  return report;
}

}  // namespace asperity::web
