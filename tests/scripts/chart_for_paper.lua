-- SPDX-License-Identifier: GPL-3.0-or-later
-- A figure with the width and the text of a journal: means with intervals, and the law fitted to the rows.
--! output: gives no room:	true
--! output: another column:	true
--! file: figure.svg: width="85mm"
--! file: figure.svg: mean of y
--! file: figure.svg: fit, 95 % band
--! file: two.svg: width="60mm"
--! not output: false
local lab = require "asperity"
local rows = {}
for k = 1, 5 do
  for i = 1, 4 do rows[#rows + 1] = { ["F [N]"]=2 ^ k, ["y [nm]"]=10 * 2 ^ k * (1 + 0.5 * ((7 * i + 3 * k) % 4)) } end
end
local t = lab.table.from(rows)
local law, means = t:fit{ x="F", y="y", model="power" }, t:mean("y", { by="F" })
means:chart{ x="F", y="mean", interval={ "low", "high" }, fit=law, log_x=true, log_y=true, legend="top left",
             width="85 mm", file="figure.svg" }
means:chart{ x="F", y="mean", log_x=true, width="60 mm", font_size=6, below={ y="u", log_y=true }, file="two.svg" }
local function refusal(keys)
  local done, why = pcall(means.chart, means, keys)
  return not done and why
end
local why = refusal{ x="F", y="mean", width="25 mm", font_size=12, file="d.svg" }
print("gives no room:", why:find("a `font_size` of at most 3", 1, true) ~= nil)
why = refusal{ x="F", y="sd", fit=law, file="d.svg" }
print("another column:", why:find("`fit` is of `y`", 1, true) ~= nil)
