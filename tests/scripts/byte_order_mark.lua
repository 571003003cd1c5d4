-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script with a byte-order mark at its beginning, as some editors write it.
--! output: read
print "read"
