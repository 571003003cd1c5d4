-- SPDX-License-Identifier: GPL-3.0-or-later
-- pcall does not swallow the end of the run's time.
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
while true do pcall(function() while true do end end) end
