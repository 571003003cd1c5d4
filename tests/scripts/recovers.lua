-- SPDX-License-Identifier: GPL-3.0-or-later
-- Errors of every kind are caught by pcall, in coroutines too, and the run goes on to its end.
--! output: recovered 700
local lab = require "asperity"
local recovered = 0
for k = 1, 100 do
  for _, mistake in ipairs{
    function() lab.surface.flat{ cells=8 } end, function() lab.surface.flat(k) end, function() error{} end,
    function() error() end, function() return lab.nothing end, function() return (nil)() end,
    function() coroutine.wrap(function() lab.material "none" end)() end } do
    if not pcall(mistake) then recovered = recovered + 1 end
  end
end
print("recovered " .. recovered)
