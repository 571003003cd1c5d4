-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 4
os.exit(4.0)
