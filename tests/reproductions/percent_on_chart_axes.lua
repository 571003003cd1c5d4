-- SPDX-License-Identifier: GPL-3.0-or-later
-- A share in per cent is drawn as 10 to 30, with its unit on the axis.
--! file: n.svg: share (%)
--! file: n.svg: 30
local lab = require "asperity"
local b = lab.notebook "n"
b:write{ z=1, ["share [%]"]=10 }
b:write{ z=2, ["share [%]"]=30 }
b:chart{ x="z", y="share", file="n.svg" }
