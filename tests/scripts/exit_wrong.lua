-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: exit_wrong.lua:4: bad argument #1 to 'exit' (number expected, got string)
os.exit "soon"
