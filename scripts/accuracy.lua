-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions shared by the studies of examples/accuracy. Each study has one question of work and precision; this
-- module shows the answer: the table, the chart, the cheapest setting for 10 %, 1 % and 0.1 %. It leaves a part of
-- docs/accuracy.md in the run directory: `section.md`. `require "asperity.accuracy"`. It computes nothing.
local lab = require "asperity"
local accuracy = {}

accuracy.bounds = { 0.1, 0.01, 0.001 }

local function percent(share) return ("%g %%"):format(100 * share) end

-- Writes a part of the page: its lines, then the script and how it was run. Parts are in the order of `number`; 0 is
-- the first.
function accuracy.write(number, lines)
  local script = ("examples/accuracy/%s.lua"):format(arg[0]:match "([^/]+)%.lua$")
  local file <close> = assert(io.open(("section_%02d.md"):format(number), "w"))
  file:write(table.concat(lines, "\n"), ("\n\nScript: `%s`.\n\nAgain: `asperity run %s%s`.\n"):format(script, script,
    #arg > 0 and " -- " .. table.concat(arg, " ") or ""))
end

-- Shows a study, and writes its part of the page. The keys: `number` on the page, `title`, the `question`, the
-- assumed `truth`, the `study` itself, and its lesson, `finding`.
function accuracy.show(given)
  for _, key in ipairs{ "number", "title", "question", "truth", "study", "finding" } do
    assert(given[key], key .. " is missing")
  end
  local name = given.name or arg[0]:match "([^/]+)%.lua$" or arg[0]
  local chart = name .. ".svg"
  given.study:chart(chart)
  print(given.study)

  local lines = {}
  local function add(...) for _, line in ipairs{ ... } do lines[#lines + 1] = line end end
  add("## " .. given.title, "", given.question, "", "*Truth.* " .. given.truth, "", "```")
  add(tostring(given.study), "```", "", ("![Error against seconds](pictures/accuracy/%s)"):format(chart), "")
  add("| for | cheapest setting | seconds | error |", "| ---: | --- | ---: | ---: |")
  for _, bound in ipairs(accuracy.bounds) do
    local found, best = pcall(given.study.cheapest, given.study, { error = bound })
    if found then
      add(("| %s | `%s` | %.2g | %.1g |"):format(percent(bound), tostring(best), best.seconds, best.error))
    else
      add(("| %s | none of these | | |"):format(percent(bound)))
    end
  end
  add("", given.finding)
  accuracy.write(given.number, lines)
end

return accuracy
