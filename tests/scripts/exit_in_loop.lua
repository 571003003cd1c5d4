-- SPDX-License-Identifier: GPL-3.0-or-later
-- From inside a coroutine inside a protected call inside a loop over an iterator.
--! exit: 0
--! output: leaving
--! file: rows.csv: 2
local lab = require "asperity"
local book = lab.notebook "rows"
pcall(function()
  coroutine.wrap(function()
    for k = 1, 10 do
      book:write{ k=k }
      if k == 2 then print "leaving" os.exit() end
    end
  end)()
end)
