-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script that fails as it is written is told as `asperity run` tells it.
--! command: accuracy
--! flags: --trace
--! exit: 1
--! error: accuracy_error.lua:9: no such luck
--! error: stack traceback
local lab = require "asperity"
error "no such luck"
