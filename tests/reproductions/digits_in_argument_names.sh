#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Names of arguments may hold digits.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'print(require "asperity.arguments"({ H1=1 }, ...).H1 * 10)' > s.lua
ends 0 20 "$program" run s.lua -- H1=2
