-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sentences for a reader: `require "asperity.prose"([[ ... ]], ...)` inserts the further values into the text like
-- string.format and prints each paragraph as one line. The terminal or the page wraps it. Lines of the text may have
-- any length; an empty line separates paragraphs.
return function(text, ...)
  if type(text) ~= "string" then error("a text was expected, got a " .. type(text), 2) end
  if select("#", ...) > 0 then text = text:format(...) end
  -- No loop over paragraphs: during a check the text may be unknown.
  local lines = text:gsub("^%s+", ""):gsub("%s+$", ""):gsub("[ \t]*\n[ \t]*\n%s*", "\1"):gsub("%s*\n%s*", " ")
  print((lines:gsub("\1", "\n\n")))
end
