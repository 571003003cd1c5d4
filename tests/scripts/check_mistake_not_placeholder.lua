-- SPDX-License-Identifier: GPL-3.0-or-later
-- An error of the script's own is not taken for the end of what can be checked.
--! command: check
--! exit: 1
--! error: this is a placeholder
--! not output: checked to line
error "this is a placeholder"
