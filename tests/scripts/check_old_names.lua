-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_old_names.lua:17: notebook:fit: `model` is function(x, …); parameters come first: function(q, row)
--! error: check_old_names.lua:18: notebook:histogram: histogram takes the column first; write t:histogram("mu"
--! error: check_old_names.lua:19: protocol:apply: a state has no field `contacts`, which is called `nodes_in_contact` now
--! error: check_old_names.lua:20: a state has no field `contacts`, which is called `nodes_in_contact` now
--! error: check_old_names.lua:21: a state has no field `contacts`, which is called `nodes_in_contact` now
--! error: column `pressure` is a pressure, and `um` is a unit of a length
--! error: check_old_names.lua:23: a probe result has no field `contacts`, which is called `nodes_in_contact` now
local lab = require "asperity"
local c = lab.contact{ lower=lab.surface.flat{ cells=4096, size=1, material=lab.material "steel" }, upper=lab.rigid, boundary="periodic",
  effects={ elasticity="half_space" } }
local p = lab.protocol{ { press={ pressure="1 MPa" } } }
local b = lab.notebook "b"
b:write{ x=1, y=2 }
b:fit{ x="x", y="y", model=function(x, q) return q.a * x end, start={ a=1 } }
b:histogram{ of="x" }
p:apply(c, { columns={ "contacts" } })
for st in c:sweep{ pressure={ "1 MPa" } } do print(st.contacts) end
local states = c:sweep{ pressure={ "1 MPa" } }:table{ "contacts", "pressure [um]" }
local t = lab.tilt_stage{ mass="50 g", specimen_area="1 cm^2", friction=lab.friction{ tau0="500 MPa", alpha=0.2 }, contact=c }:raise()
print(states:mean "pressure", t.probes[1].contacts, #t.probes)
for _, probe in ipairs(t.probes) do print(probe.contacts) end
