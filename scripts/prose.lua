-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sentences for a reader: `require "asperity.prose"([[ ... ]], ...)` puts the further values into the text as
-- string.format does and prints each paragraph as one line, which a terminal or the page wraps as wide as it is. In the
-- text, lines are as long as its writer likes; an empty one parts two paragraphs.
return function(text, ...)
  if type(text) ~= "string" then error("a text was expected, got a " .. type(text), 2) end
  if select("#", ...) > 0 then text = text:format(...) end
  -- Without a loop over paragraphs: in a check the text may be one that is not known before the run.
  local lines = text:gsub("^%s+", ""):gsub("%s+$", ""):gsub("[ \t]*\n[ \t]*\n%s*", "\1"):gsub("%s*\n%s*", " ")
  print((lines:gsub("\1", "\n\n")))
end
