-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-memory 256M
--! exit: 1
--! error: lab.surface.flat: out of memory: requested 512 MiB
--! error: of a limit of 256 MiB; give fewer `cells`, or raise `--limit-memory`
local lab = require "asperity"
local s = lab.surface.flat{ cells=8192, size=1 }
