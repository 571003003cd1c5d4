-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: stack traceback:
--! error: error_unshowable.lua:5: 
error(setmetatable({}, { __tostring=function() error "not even this" end }))
