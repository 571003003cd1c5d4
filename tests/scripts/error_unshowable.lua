-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: stack traceback:
--! error: error_unshowable.lua:6: 
error(setmetatable({}, { __tostring=function() error "not even this" end }))
