-- SPDX-License-Identifier: GPL-3.0-or-later
-- Warnings with different numbers only are one line with a count; the journal has each warning. A mean by groups
-- warns once for all its groups.
--! error: warnings_of_one_kind.lua:19: surface:masked: 1 of 4096 measured points
--! error: warning: 3 more like this one, with other numbers: 
--! error: warning: column `mu` where `p` = 1, and in 5 more of 6 groups: 
--! not error: masked: 2 of 4096
--! file: journal.jsonl: masked: 2 of 4096 measured points
--! file: journal.jsonl: masked: 4 of 4096 measured points
local lab = require "asperity"

local flat = lab.surface.self_affine{ cells=64, size="64 um", hurst=0.8, rms_height="10 nm", short_wave="4 um", seed=1 }:heights()
for spikes = 1, 4 do
  local heights = {}
  for j, row in ipairs(flat) do
    heights[j] = table.move(row, 1, #row, 1, {})
    if j % 12 == 5 and j // 12 < spikes then heights[j][30] = 1e-5 end
  end
  lab.surface.from_table{ size="64 um", heights=heights }:masked{ outliers="mad" }
end

local rows = {}
for p = 1, 6 do
  for k = 1, 2 do rows[#rows + 1] = { p=p, mu=0.1 * p + 0.01 * k } end
end
lab.table.from(rows):mean("mu", { by="p" })
