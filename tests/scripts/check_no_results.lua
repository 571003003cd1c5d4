-- SPDX-License-Identifier: GPL-3.0-or-later
-- An assertion that no result enters is judged by a check, too.
--! command: check
--! error: one and one are two
--! exit: 1
local lab = require "asperity"
assert(1 + 1 == 3, "one and one are two")
