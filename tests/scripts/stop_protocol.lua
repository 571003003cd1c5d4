-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C among the events of a protocol.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! not output: finished
--! file: manifest.json: "status": "interrupted"
--! file: journal.jsonl: "function":"contact:press"
local lab = require "asperity"
local s = lab.surface.sine{ cells=64, size=1, amplitude="1 mm", material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
io.stdout:setvbuf "no"
for event in lab.protocol{ { press={ pressure="1 MPa" } }, { release=true } }:repeated{ repeats=1000000 }:on(c) do
  if event.index == 3 then print "ready" end
end
print "finished"
