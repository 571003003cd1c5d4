-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: error_global.lua:4: the global `surfce` was never set
surfce()
