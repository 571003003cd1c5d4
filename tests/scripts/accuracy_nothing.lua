-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script that returns a number in which nothing can be made finer.
--! command: accuracy
--! exit: 1
--! error: the script has no `cells` of a surface and no contact
return 1
