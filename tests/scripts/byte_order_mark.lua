-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script that begins with a byte-order mark, as some editors write it.
--! output: read
print "read"
