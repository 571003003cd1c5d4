-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
table.sort({ 3, 2, 1 }, function() while true do end end)
