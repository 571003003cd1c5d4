-- SPDX-License-Identifier: GPL-3.0-or-later
-- pcall does not swallow Ctrl-C.
--! stop at: ready
--! exit: 130
io.stdout:setvbuf "no"
print "ready"
while true do pcall(function() while true do end end) end
