-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: (error value: nil)
--! error: error_nil.lua:6: in main chunk
error(nil)
