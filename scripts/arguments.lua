-- SPDX-License-Identifier: GPL-3.0-or-later
-- The arguments of a run as named options: `asperity run SCRIPT -- seeds=5 flat=rigid` with
-- `local options = require "asperity.arguments"({ seeds = 20, flat = "quartz" }, ...)`. The table holds
-- every name with its default, whose type (whole number, number or text) the argument must have.
local lab = require "asperity"

return function(defaults, ...)
  local options = {}
  for name, value in pairs(defaults) do options[name] = value end
  for _, word in ipairs{ ... } do
    local name, text = word:match "^([%a_][%w_]*)=(.+)$"
    local default = defaults[name]
    if default == nil then
      local names = {}
      for known in lab.sorted(defaults) do names[#names + 1] = known .. "=" end
      error("`" .. word .. "` is no argument of this script; it takes " .. table.concat(names, ", "), 0)
    end
    local value, kind = text, math.type(default)
    if kind then value = tonumber(text) end
    if kind == "integer" then value = math.tointeger(value) end
    if value == nil then
      local wanted = kind == "integer" and "whole number" or "number"
      error(("`%s` is `%s`; give a %s"):format(name, text, wanted), 0)
    end
    options[name] = value
  end
  return options
end
