-- SPDX-License-Identifier: GPL-3.0-or-later
-- Compares a guess with the result in one line: `require "asperity.guess"{ said = my_guess.percent, found = 0.26,
-- of = "the share that touches", unit = "%" }`. Without a guess it prints nothing. A guess is a number, or a string
-- with a number and perhaps its unit ("10 %"); any other text gets an answer. `near=0.05` accepts 5 per cent as near,
-- in place of 20: give it where a wrong idea is closer than that. A table of several guesses is declared by
-- `guess.names(my_guess, "percent", "growth")`: another key is an error before the computation.
local keys = { said=true, found=true, of=true, unit=true, near=true }

-- The number in a guess; nil without a number or with another unit.
local function number_of(said, unit)
  if type(said) ~= "string" then
    -- Not infinite, not nan.
    return math.type(said) and math.abs(said) < math.huge and said or nil
  end
  local digits, behind = said:match "^%s*([-+]?%d*%.?%d*[eE]?[-+]?%d*)%s*(.-)%s*$"
  local number = digits and tonumber(digits)
  if behind ~= "" and behind ~= unit then return nil end
  return number
end

local function verdict(number, found, near)
  if math.abs(number - found) <= near * math.abs(found) then return "which is near" end
  if number * found <= 0 then return "which is not near" end
  local ratio = number / found
  return ratio > 1 and ("%.2g times too much"):format(ratio) or ("%.2g times too little"):format(1 / ratio)
end

local function compare(_, guess)
  for key in pairs(guess) do
    if not keys[key] then error("a guess has no key `" .. tostring(key) .. "`", 2) end
  end
  if guess.said == nil then return end
  local unit = guess.unit and " " .. guess.unit or ""
  local number = number_of(guess.said, guess.unit)
  if not number then
    print(("You said `%s` of %s, which is no number%s: it is %.3g%s."):format(tostring(guess.said), guess.of,
      guess.unit and " of " .. guess.unit or "", guess.found, unit))
    return
  end
  print(("You said %g%s of %s: it is %.3g%s, %s."):format(number, unit, guess.of, guess.found, unit,
    verdict(number, guess.found, guess.near or 0.2)))
end

local function names(said, ...)
  local known = { ... }
  local form = "{ " .. table.concat(known, "=nil, ") .. "=nil }"
  if type(said) ~= "table" then
    error(("my_guess is %s; give its numbers by name, as in %s"):format(tostring(said), form), 2)
  end
  local asked, strange = {}, {}
  for _, name in ipairs(known) do asked[name] = true end
  for key in pairs(said) do
    if not asked[key] then strange[#strange + 1] = math.type(key) and ("[%s]"):format(key) or tostring(key) end
  end
  table.sort(strange)
  if #strange > 0 then
    error(("my_guess has `%s`, which the lesson does not ask for; its names are %s"):format(
      table.concat(strange, "` and `"), table.concat(known, " and ")), 2)
  end
end

return setmetatable({ names=names }, { __call=compare })
