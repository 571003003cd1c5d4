#!/usr/bin/env -S asperity run
-- SPDX-License-Identifier: GPL-3.0-or-later
-- A first line for the shell is no mistake, and lines are still counted from it.
--! exit: 1
--! error: shebang.lua:6: counted
error "counted"
