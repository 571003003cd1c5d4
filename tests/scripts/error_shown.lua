-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: (error value: the last straw)
--! error: error_shown.lua:6: in main chunk
error(setmetatable({}, { __tostring=function() return "the last straw" end }))
