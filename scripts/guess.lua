-- SPDX-License-Identifier: GPL-3.0-or-later
-- Compares a guess with the result in one line, for example `require "asperity.guess"{ said=my_guess.percent,
-- name="percent", found=0.26, of="the share that touches", unit="%", near=0.3 }`. `near=0.3` accepts 30 per cent more
-- or less; each lesson sets its own tolerance. A guess is a number, or a string with a number and perhaps its unit
-- ("10 %", "0,25"). A choice has `replies` in place of `near`: a sentence for each wrong choice, as in
-- `{ said=my_guess, found="more", of="the depth", replies={ less="…", equal="…" } }`.
--
-- Notebook "guesses" stores the guess and the result. Without a guess nothing is printed.
-- `guess.names(my_guess, "percent", "growth")` declares a table of guesses, `guess.choices(my_guess, "less", "more")`
-- the choices: other names and choices are errors before the computation.
local lab = require "asperity"
local keys = { said=true, name=true, found=true, of=true, unit=true, near=true, replies=true }

-- The number in a guess; nil without a number or with another unit.
local function number_of(said, unit)
  if type(said) ~= "string" then
    -- Not infinite, not nan.
    return math.type(said) and math.abs(said) < math.huge and said or nil
  end
  local digits, behind = said:match "^%s*([-+]?%d*[.,]?%d*[eE]?[-+]?%d*)%s*(.-)%s*$"
  local number = digits and tonumber((digits:gsub(",", ".")))
  if behind ~= "" and behind ~= unit then return nil end
  return number
end

local function distance(number, found, near)
  if math.abs(number - found) <= near * math.abs(found) then return "which is near" end
  if number * found <= 0 then return "which is not near" end
  local ratio = number / found
  return ratio > 1 and ("%.2g times too much"):format(ratio) or ("%.2g times too little"):format(1 / ratio)
end

local function number_verdict(guess)
  local unit = guess.unit and " " .. guess.unit or ""
  local number = number_of(guess.said, guess.unit)
  if not number then
    return ("You said `%s` of %s, which is no number%s: it is %.3g%s."):format(tostring(guess.said), guess.of,
      guess.unit and " of " .. guess.unit or "", guess.found, unit)
  end
  return ("You said %g%s of %s: it is %.3g%s, %s."):format(number, unit, guess.of, guess.found, unit,
    distance(number, guess.found, guess.near))
end

local function choice_verdict(guess)
  local said = tostring(guess.said)
  if said == guess.found then return ('You said "%s" of %s, and so it is.'):format(said, guess.of) end
  local reply = guess.replies[said]
  return ('You said "%s" of %s: it is "%s".%s'):format(said, guess.of, guess.found, reply and " " .. reply or "")
end

local function compare(_, guess)
  for key in pairs(guess) do
    if not keys[key] then error("a guess has no key `" .. tostring(key) .. "`", 2) end
  end
  if (guess.near == nil) == (guess.replies == nil) then
    error("a guess needs either `near`, its tolerance, or `replies` to wrong choices; for example near=0.1", 2)
  end
  local said = guess.said
  if guess.replies then said = said and tostring(said) else said = number_of(said, guess.unit) end
  lab.notebook "guesses":write{ guess=guess.name or "", said=said, found=guess.found, unit=guess.unit }
  if guess.said ~= nil then print((guess.replies and choice_verdict or number_verdict)(guess)) end
end

local function names(said, ...)
  local known = { ... }
  local form = "{ " .. table.concat(known, "=nil, ") .. "=nil }"
  if type(said) ~= "table" then
    error(("my_guess is %s; give its values by name, as in %s"):format(tostring(said), form), 2)
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

local function choices(said, ...)
  local known = {}
  for _, choice in ipairs{ ... } do known[choice] = true end
  for _, value in pairs(type(said) == "table" and said or { said }) do
    if not known[tostring(value)] then
      error(('my_guess is `%s`; choose one of "%s"'):format(tostring(value), table.concat({ ... }, '", "')), 2)
    end
  end
end

return setmetatable({ names=names, choices=choices }, { __call=compare })
