-- SPDX-License-Identifier: GPL-3.0-or-later
-- A failed expectation makes the run end with 1, after everything is recorded.
--! exit: 1
--! output: still running
--! error: failed: `mu`
--! file: friction.csv: 0.4
--! file: friction.csv: 0.6
--! file: manifest.json: "passed": false
local lab = require "asperity"
local book = lab.notebook "friction"
book:write{ N=1, mu=0.4 }
assert(book:expect("mu", { where={ N=1 }, near=0.5, within=0.05 }) == false)
book:write{ N=2, mu=0.6 }
print "still running"
