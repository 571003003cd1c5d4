-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: asperity:
--! error: error_text.lua:13: out of specimens
--! error: stack traceback:
--! error: in local 'press'
--! file: manifest.json: "status": "failed"
--! file: before.csv: 12
local lab = require "asperity"
lab.notebook "before":write{ a=12 }
local function press()
  error "out of specimens"
end
press()
