-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: error_syntax.lua:5: unexpected symbol near '='
--! file: manifest.json: "status": "failed"
local x = = 3
