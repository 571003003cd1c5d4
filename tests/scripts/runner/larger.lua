-- SPDX-License-Identifier: GPL-3.0-or-later
-- A module of check_module_line.lua, whose path depends on what it is given.
return function(a, b)
  if a > b then return a end
  return b
end
