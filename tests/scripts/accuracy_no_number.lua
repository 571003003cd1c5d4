-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: accuracy
--! exit: 1
--! error: the script returned a list of 2; `asperity accuracy` studies a script that returns one number
--! file: manifest.json: "status": "failed"
return { 1, 2 }
