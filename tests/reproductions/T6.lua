-- SPDX-License-Identifier: GPL-3.0-or-later
-- T6: a guess is compared with what was found, in one line, and only where one was made; no unit is said twice, and what
-- is no number is answered.
--! output: You said 10 % of the share: it is 0.261 %
--! output: You said `half` of the share, which is no number
--! not output: nothing
--! output: which is no number of %: it is 0.261 %.
--! not output: % %
--! not output: times too little
local guess = require "asperity.guess"
for _, said in ipairs{ "10 %", 10, "half", 0 / 0, 1 / 0 } do guess{ said=said, found=0.261, of="the share", unit="%" } end
guess{ said=nil, found=0.261, of="nothing", unit="%" }
