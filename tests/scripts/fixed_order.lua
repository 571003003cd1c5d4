-- SPDX-License-Identifier: GPL-3.0-or-later
-- pairs and next have one order, whatever the history of the table: numbers, strings by their bytes, booleans. The
-- same order holds in modules and in the cases of ensembles.
--! output: in order
local lab = require "asperity"

local function keys(t)
  local list = {}
  for k, v in pairs(t) do assert(rawequal(t[k], v)) list[#list + 1] = k end
  local by_next, k = {}, next(t)
  while k ~= nil do by_next[#by_next + 1] = k k = next(t, k) end
  assert(#by_next == #list)
  for n, key in ipairs(list) do assert(rawequal(by_next[n], key), tostring(key)) end
  return list
end
local function says(t)
  local list = {}
  for n, key in ipairs(keys(t)) do list[n] = tostring(key) end
  return table.concat(list, " ")
end

assert(says{} == "")
assert(says{ 10, 20, 30 } == "1 2 3")
assert(says{ full=1, light=2, heavy=3, middle=4 } == "full heavy light middle")
assert(says{ [true]=1, [false]=2, b=3, a=4, [2.5]=5, [-1]=6, [3]=7, ["10"]=8, ["9"]=9 } == "-1 2.5 3 10 9 a b false true")
assert(says{ [-math.huge]=1, [math.huge]=2, [0]=3, [-0.5]=4, [-2]=5, [1e300]=6 } == "-inf -2 -0.5 0 1e+300 inf")
assert(says{ [math.mininteger]=1, [math.maxinteger]=2, [math.maxinteger - 1]=3, [2.0 ^ 53]=4, [2 ^ 53 | 1]=5 }
  == "-9223372036854775808 9007199254740992 9007199254740993 9223372036854775806 9223372036854775807")
local bytes = keys{ ["a\0b"]=1, a=2, ["a\0"]=3, [""]=4, ["\255"]=5, ["eight by"]=6, ["eight bytes"]=7, ["eight byt\0"]=8, Z=9 }
local wanted = { "", "Z", "a", "a\0", "a\0b", "eight by", "eight byt\0", "eight bytes", "\255" }
for n, key in ipairs(wanted) do assert(bytes[n] == key, n) end

-- Many keys, inserted and removed in two ways.
local one, other = {}, {}
for k = 1, 3000 do one["key " .. k * 7919 % 10007] = k one[k] = k one[k / 2] = k end
for k = 5000, 1, -1 do other["gone " .. k] = k other[-k] = k end
for k in pairs(other) do other[k] = nil end
for k = 3000, 1, -1 do other[k / 2] = k other[k] = k other["key " .. k * 7919 % 10007] = k end
local a, b = keys(one), keys(other)
assert(#a == 7500 and #b == #a)
for k = 1, #a do assert(a[k] == b[k]) end

-- A loop may change and remove fields, and does not visit added fields.
local t = { a=1, b=2, c=3, d=4, [1]=5 }
local seen = {}
for k, v in pairs(t) do
  seen[#seen + 1] = k .. "=" .. v
  t[k] = nil
  if k == "a" then t.c = nil t.d = "new" t.e = "added" end
end
assert(table.concat(seen, " ") == "1=5 a=1 b=2 d=new" and says(t) == "e")
t = { a=1, b=2, c=3 }
local k = next(t)
while k do t[k] = nil k = next(t, k) end
assert(next(t) == nil and next({}) == nil)

-- Loops within loops, over one table and by hand.
local sum = ""
t = { y=1, x=2 }
for p in pairs(t) do for q in pairs(t) do sum = sum .. p .. q .. " " end end
assert(sum == "xx xy yx yy ")
local p = next(t)
assert(p == "x" and next(t, "x") == "y" and next(t, "x") == "y" and next(t, "y") == nil and next(t, "w") == "x")
local step, state, first = pairs(t)
assert(step(state, first) == "x" and step(state, "x") == "y" and step(state, first) == "x")
assert(coroutine.wrap(function() for key in pairs(t) do coroutine.yield(key) end end)() == "x")

-- Keys without an order come last, each once.
local f, u = function() end, {}
local mixed = keys{ [f]=1, [u]=2, z=3, [io.stdout]=4 }
assert(#mixed == 4 and mixed[1] == "z")

-- Values with their own loop (__pairs), and values without any loop.
local odd = setmetatable({ a=1 }, { __pairs = function(self) return function(_, k) if not k then return "own", self end end, self, nil end })
for key, value in pairs(odd) do assert(key == "own" and value == odd) end
local yielding = setmetatable({}, { __pairs = function(self) coroutine.yield "asked" return next, { a=1 }, nil end })
local co = coroutine.wrap(function() for key in pairs(yielding) do coroutine.yield(key) end end)
assert(co() == "asked" and co() == "a")
local _, message = pcall(function() for _ in pairs(nil) do end end)
assert(message:find "bad argument #1 to 'for iterator' %(table expected, got nil%)", message)
_, message = pcall(pairs)
assert(message:find "bad argument #1 to 'pairs'", message)
_, message = pcall(next, 3)
assert(message:find "table expected, got number", message)
local names = {}
for name in pairs(lab) do names[#names + 1] = name end
for n = 2, #names do assert(names[n - 1] < names[n]) end

-- A table with weak keys; a collection removes some keys.
local weak = setmetatable({}, { __mode="k" })
for n = 1, 200 do weak[{}] = n weak[n] = n end
local count = 0
for key in pairs(weak) do if type(key) == "number" then count = count + 1 end collectgarbage "step" end
assert(count == 200)

-- Cases of ensembles, also with functions captured from the script.
local own_pairs, own_next = pairs, next
local rows = lab.ensemble{ over={ seed={ 1, 2 } }, run=function()
  local loads, text = { light=1, middle=2, heavy=3, full=4 }, ""
  for name in pairs(loads) do text = text .. name .. " " end
  for name in own_pairs(loads) do text = text .. name .. " " end
  return { text=text, first=next(loads), same=own_pairs == pairs and own_next == next }
end }
for _, row in ipairs(rows) do
  assert(row.text == ("full heavy light middle "):rep(2) and row.first == "full" and row.same)
end
print "in order"
