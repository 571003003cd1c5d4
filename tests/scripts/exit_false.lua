-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
os.exit(false)
