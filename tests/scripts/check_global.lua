-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_global.lua:5: the global `lbsurface` was never set
print(lbsurface)
