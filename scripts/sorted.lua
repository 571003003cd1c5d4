-- SPDX-License-Identifier: GPL-3.0-or-later
-- lab.sorted(t): iterates over a table in the order of its keys, numbers first, then names. pairs() guarantees no
-- order, so a script could differ between interpreters.
local function before(a, b)
  if type(a) == type(b) then return a < b end
  return type(a) == "number"
end

return function(t)
  if type(t) ~= "table" and type(t) ~= "userdata" then
    error("lab.sorted was given a " .. type(t) .. "; give a table", 2)
  end
  local keys, stranger = {}, nil
  local walked = pcall(function()
    for key in pairs(t) do
      if type(key) ~= "number" and type(key) ~= "string" then stranger = type(key) end
      keys[#keys + 1] = key
    end
  end)
  if not walked then error("lab.sorted was given a value without entries; give a table", 2) end
  if stranger then
    error("lab.sorted met a " .. stranger .. " as a key; keys must be numbers or strings", 2)
  end
  table.sort(keys, before)
  local k = 0
  return function()
    k = k + 1
    if keys[k] ~= nil then return keys[k], t[keys[k]] end
  end
end
