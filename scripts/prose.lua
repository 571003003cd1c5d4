-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sentences for a reader: `require "asperity.prose"([[ ... ]], ...)` puts the further values into the text as
-- string.format does and prints each paragraph as one line, which a terminal or the page wraps as wide as it is. In the
-- text, lines are as long as its writer likes; an empty one parts two paragraphs.
return function(text, ...)
  if type(text) ~= "string" then error("a text was expected, got a " .. type(text), 2) end
  if select("#", ...) > 0 then text = text:format(...) end
  local paragraphs = {}
  for paragraph in (text .. "\n\n"):gmatch "(.-)\n[ \t]*\n" do
    local line = paragraph:gsub("^%s+", ""):gsub("%s+$", ""):gsub("%s*\n%s*", " ")
    if line ~= "" then paragraphs[#paragraphs + 1] = line end
  end
  print(table.concat(paragraphs, "\n\n"))
end
