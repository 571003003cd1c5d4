-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: accuracy
--! exit: 1
--! error: the script ended by os.exit
--! file: manifest.json: "status": "failed"
os.exit(0)
