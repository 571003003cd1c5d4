-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: (error value: nil)
--! error: error_nil.lua:5: in main chunk
error(nil)
