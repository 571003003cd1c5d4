-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: error_table.lua:7: (error value: table: 
--! error: stack traceback:
--! error: error_table.lua:7: in main chunk
error{}
