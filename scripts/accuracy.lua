-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shows the studies of examples/accuracy: `require "asperity.accuracy"`. It computes nothing.
local accuracy = {}

-- Prints a study, draws its chart, and writes its part of docs/accuracy.md: section_NN.md in the
-- run directory, with the cheapest setting for 10 %, 1 % and 0.1 %. The keys: the place on the page
-- (`number`), `title`, `question`, the assumed `truth`, `study` and its `finding`.
function accuracy.show(given)
  local study, name = given.study, arg[0]:match "([^/]+)%.lua$"
  study:chart(name .. ".svg")
  print(study)

  local lines = { "## " .. given.title, "", given.question, "", "*Truth.* " .. given.truth, "",
    "```", tostring(study), "```", "",
    ("![Error against seconds](pictures/accuracy/%s.svg)"):format(name), "",
    "| for | cheapest setting | seconds | error |", "| ---: | --- | ---: | ---: |" }
  for _, bound in ipairs{ 0.1, 0.01, 0.001 } do
    local found, best = pcall(study.cheapest, study, { error = bound })
    lines[#lines + 1] = ("| %g %% | "):format(100 * bound) .. (found
      and ("`%s` | %.2g | %.1g |"):format(best, best.seconds, best.error) or "none of these | | |")
  end
  local script = ("examples/accuracy/%s.lua"):format(name)
  local file <close> = assert(io.open(("section_%02d.md"):format(given.number), "w"))
  file:write(table.concat(lines, "\n"), "\n\n", given.finding, "\n\nScript: `", script,
    "`.\n\nAgain: `asperity run ", script, #arg > 0 and " -- " .. table.concat(arg, " ") or "",
    "`.\n")
end

return accuracy
