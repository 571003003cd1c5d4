#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The include direction: a file of engine/ or bindings/ includes its own floor and those below, by
# its path from the project's folder, and no file of engine/ includes Lua. metrology and contact
# stand side by side and do not see each other. It reads #include lines, nothing cleverer.
# usage: floors.sh [the project's folder]
set -eu
cd "${1:-$(dirname -- "$0")/../..}"

find engine bindings \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -print | LC_ALL=C sort | awk '
  BEGIN {
    below["engine/core"] = ""
    below["engine/surface"] = "engine/core"
    below["engine/metrology"] = "engine/core engine/surface"
    below["engine/contact"] = "engine/core engine/surface"
    below["engine/plot"] = below["engine/contact"]
    below["engine/accuracy"] = below["engine/contact"] " engine/contact"
    below["engine/friction"] = below["engine/contact"] " engine/metrology engine/contact"
    below["engine/specimen"] = below["engine/friction"] " engine/friction engine/accuracy engine/experiment"
    below["engine/run"] = below["engine/contact"] " engine/contact engine/plot engine/experiment"
    below["engine/recording"] = below["engine/specimen"] " engine/specimen engine/plot"
    below["engine/experiment"] = below["engine/recording"] " engine/recording engine/run"
    below["engine/study"] = below["engine/experiment"] " engine/experiment"
    below["bindings"] = below["engine/study"] " engine/study"
  }
  function floor_of(path, part) {
    split(path, part, "/")
    return part[1] == "engine" ? part[1] "/" part[2] : part[1]
  }
  function complain(text) {
    print file ":" line ": " text
    ++found
  }
  function check(target, quoted, floor) {
    if (own != "bindings" && target ~ /(^|\/)(lua|luaconf|lualib|lauxlib)\.(h|hpp)$/)
      return complain("the engine does not know Lua, and this includes " target)
    if (!quoted) {
      if (target ~ /^(engine|bindings|tests|bench)\//) complain("include " target " in quotes")
      return
    }
    floor = floor_of(target)
    if (!(floor in below))
      complain("include " target " by its path from the project folder, below engine/ or bindings/")
    else if (floor != own && index(" " below[own] " ", " " floor " ") == 0)
      complain(own " does not stand on " floor ", and this includes " target)
  }
  {
    file = $0
    line = 0
    own = floor_of(file)
    if (!(own in below)) {
      complain(own " is no floor that this check knows")
      next
    }
    ++files
    while ((status = (getline text < file)) > 0) {
      ++line
      if (text !~ /^[ \t]*#[ \t]*include/) continue
      if (match(text, /"[^"]*"/)) check(substr(text, RSTART + 1, RLENGTH - 2), 1)
      else if (match(text, /<[^>]*>/)) check(substr(text, RSTART + 1, RLENGTH - 2), 0)
      else complain("this check cannot read the name included here")
    }
    if (status < 0) complain("cannot be read")
    close(file)
  }
  END {
    if (files == 0) {
      print "no file of engine/ or bindings/ was found"
      exit 1
    }
    if (found) exit 1
    print files " files include only their own floor and those below"
  }'
