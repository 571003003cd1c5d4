-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --seed 2
--! output: different
local first = math.random(1 << 60)
math.randomseed(1, 0)
print(first == math.random(1 << 60) and "equal" or "different")
