-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions shared by the hard cases of tests/stability/cases. Each case names the swept edge and the failures
-- elsewhere, shows its evidence, and writes its page for docs/stability, `page.md`, and its row of docs/stability.md,
-- `row.md`, into the run directory. `require "asperity.hard_case"`. This module computes nothing.
local lab = require "asperity"
local Case = {}
Case.__index = Case

-- A case: its `number` in the table, `title`, the swept `edge`, the failure `elsewhere`, and the behaviour `here`.
local function hard_case(given)
  local name = arg[0]:match "([^/]+)%.lua$" or arg[0]
  local case = setmetatable({ name = name, failed = 0, lines = {}, refusals = {}, facts = {} }, Case)
  for _, key in ipairs{ "number", "title", "edge", "elsewhere", "here" } do
    case[key] = assert(given[key], key .. " is missing")
  end
  print(("%s\n  edge: %s"):format(case.title, case.edge))
  return case
end

local function add(case, ...)
  for _, line in ipairs{ ... } do table.insert(case.lines, line) end
end

-- An expectation of a notebook's column; a failed expectation is reported on the page too.
function Case:expect(book, column, options)
  if not book:expect(column, options) then self.failed = self.failed + 1 end
end

local function text_of(format, value)
  if value == nil then return "" end
  if type(value) ~= "number" then return tostring(value) end
  if value ~= value or value == math.huge then return tostring(value) end
  if value == 0 then return "0" end -- an exact result
  return (format:format(value):gsub("e([-+])0(%d)", "e%1%2"):gsub("e%+", "e"):gsub("e0$", ""))
end

-- The rows of a notebook as a table, on the page and printed. Every column is { name, format, heading }; the heading
-- is optional. `where` selects rows.
function Case:evidence(book, caption, columns, where)
  local heads, rules, width, rows = {}, {}, {}, {}
  for k, column in ipairs(columns) do
    heads[k], rules[k] = column[3] or column[1], "---:"
    width[k] = #heads[k]
  end
  for _, row in ipairs(book:rows()) do
    local chosen = true
    for key, value in pairs(where or {}) do chosen = chosen and row[key] == value end
    if chosen then
      local cells = {}
      for k, column in ipairs(columns) do
        cells[k] = text_of(column[2], row[column[1]])
        width[k] = math.max(width[k], #cells[k])
      end
      table.insert(rows, cells)
    end
  end
  add(self, "", caption, "", "| " .. table.concat(heads, " | ") .. " |", "| " .. table.concat(rules, " | ")
    .. " |")
  print("\n  " .. caption)
  table.insert(rows, 1, heads)
  for r, cells in ipairs(rows) do
    local padded = {}
    for k, cell in ipairs(cells) do padded[k] = (" "):rep(width[k] - #cell) .. cell end
    print("  " .. table.concat(padded, "  "))
    if r > 1 then add(self, "| " .. table.concat(cells, " | ") .. " |") end
  end
end

-- A chart of a notebook, drawn as notebook:chart does.
function Case:chart(book, caption, options)
  local file = self.name .. "_" .. options.file
  options.file = file
  book:chart(options)
  add(self, "", ("![%s](../pictures/stability/%s)"):format(caption, file))
end

-- A statement that is true or false.
function Case:holds(what, found)
  self.book_of_facts = self.book_of_facts or lab.notebook "facts"
  table.insert(self.facts, what .. (found and "" or ": **does not hold**"))
  self.book_of_facts:write{ what = what, holds = found and 1 or 0 }
  self:expect(self.book_of_facts, "holds", { where = { what = what }, at_least = 1, label = what })
end

-- Expects an error that contains every given text. Returns the error.
function Case:refused(what, call, ...)
  self.book_of_refusals = self.book_of_refusals or lab.notebook "refusals"
  local accepted, message = pcall(call)
  local named = not accepted and type(message) == "string"
  for _, part in ipairs{ ... } do named = named and message:find(part, 1, true) ~= nil end
  message = accepted and "was accepted" or tostring(message):gsub("^[^\n]-%.lua:%d+: ",
    ""):gsub("\nstack traceback.*", "")
    :gsub('"[^"]*/([^"/]+)"', '"%1"') -- file names without the folder of this run
  self.book_of_refusals:write{ what = what, refused = named and 1 or 0, error = message }
  self:expect(self.book_of_refusals, "refused", { where = { what = what }, at_least = 1, label = what })
  table.insert(self.refusals, { what = what, message = message, named = named })
  return message
end

local function write(name, lines)
  local file <close> = assert(io.open(name, "w"))
  file:write(table.concat(lines, "\n"), "\n")
end

-- Writes the page and the row: the `worst` error or the refusal, and the `verdict`, a few words each.
function Case:finish(given)
  local verdict = self.failed == 0 and given.verdict or ("**fails: %d**"):format(self.failed)
  if #self.facts > 0 then
    add(self, "", "Exactly so, or the case fails:", "")
    for _, fact in ipairs(self.facts) do add(self, "- " .. fact) end
  end
  if #self.refusals > 0 then
    add(self, "", "Refused, in these words:", "", "| asked | answer |", "| --- | --- |")
    for _, refusal in ipairs(self.refusals) do
      add(self, ("| %s | %s%s |"):format(refusal.what, refusal.named and "" or "**not as it should be:** ",
        (refusal.message:gsub("|", "\\|"):gsub("\n%s*", "; "))))
    end
  end
  write("row.md", { ("%03d| [%s](stability/%s.md) | %s | %s | %s |"):format(self.number, self.title, self.name,
    self.edge, given.worst, verdict) })
  local head = { "# " .. self.title, "", "<!-- Generated by tests/stability/report.sh; do not edit. -->", "",
    "[All hard cases](../stability.md)", "", "**Failures elsewhere.** " .. self.elsewhere, "",
    "**This program.** " .. self.here, "",
    ("`asperity run tests/stability/cases/%s.lua` prints these numbers."):format(self.name) }
  table.move(self.lines, 1, #self.lines, #head + 1)
  table.move(head, 1, #head, 1, self.lines)
  write("page.md", self.lines)
  print(("\n  exact facts: %d, refusals: %d; worst: %s; verdict: %s"):format(#self.facts, #self.refusals,
    given.worst,
    verdict))
end

return hard_case
