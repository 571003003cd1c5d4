-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: (error value: table: 
--! error: stack traceback:
--! error: error_table.lua:6: in main chunk
error{}
