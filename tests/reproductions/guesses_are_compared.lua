-- SPDX-License-Identifier: GPL-3.0-or-later
-- A guess is compared with the result in one line, and only if the user made one. No unit is printed twice, and a guess
-- without a number gets an answer.
--! output: You said 10 % of the share: it is 0.261 %
--! output: You said `half` of the share, which is no number
--! not output: nothing
--! output: which is no number of %: it is 0.261 %.
--! not output: % %
--! not output: times too little
local guess = require "asperity.guess"
for _, said in ipairs{ "10 %", 10, "half", 0 / 0, 1 / 0 } do guess{ said=said, found=0.261, of="the share", unit="%" } end
guess{ said=nil, found=0.261, of="nothing", unit="%" }
