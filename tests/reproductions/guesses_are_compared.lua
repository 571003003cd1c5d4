-- SPDX-License-Identifier: GPL-3.0-or-later
-- A guess is compared with the result in one line, and only if the user made one. No unit is printed twice, and a guess
-- without a number gets an answer.
--! output: You said 10 % of the share: it is 0.261 %, 38 times too much.
--! output: You said 0.25 % of the share: it is 0.261 %, which is near.
--! output: You said 0.2 % of the share: it is 0.261 %, 1.3 times too little.
--! output: You said `half` of the share, which is no number
--! not output: nothing
--! output: which is no number of %: it is 0.261 %.
--! not output: % %
--! output: You said "less" of the depth: it is "more". Nothing bulges.
--! output: You said "more" of the depth, and so it is.
--! output: a guess needs either `near`
--! output: my_guess is `lses`; choose one of "less", "more"
--! output: 10 guesses are stored
local guess = require "asperity.guess"
for _, said in ipairs{ "10 %", 10, "0,25", 0.2, "half", 0 / 0, 1 / 0 } do
  guess{ said=said, found=0.261, of="the share", unit="%", near=0.05 }
end
guess{ said=nil, found=0.261, of="nothing", unit="%", near=0.05 }
for _, said in ipairs{ "less", "more" } do
  guess{ said=said, found="more", of="the depth", replies={ less="Nothing bulges." } }
end
print(pcall(guess, { said=1, found=1, of="the share" }))
print(pcall(guess.choices, { depth="lses" }, "less", "more"))
guess.choices({ depth=nil }, "less", "more")
print(#require "asperity".notebook "guesses":rows() .. " guesses are stored")
