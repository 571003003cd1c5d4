-- SPDX-License-Identifier: GPL-3.0-or-later
-- A check asks a study's function once and finds the mistake in it.
--! command: check
--! exit: 1
--! error: did you mean `amplitude`?
local lab = require "asperity"
lab.work_precision{ truth={ cells=4096 }, try={ { name="finer grid", cells={ 2048, 4096 } } }, ask=function(knobs)
  return lab.surface.sine{ cells=knobs.cells, size=1, amplitud="1 um" }:roughness().Ra
end }
