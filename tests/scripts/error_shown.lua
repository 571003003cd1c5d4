-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: (error value: the last straw)
--! error: error_shown.lua:5: in main chunk
error(setmetatable({}, { __tostring=function() return "the last straw" end }))
