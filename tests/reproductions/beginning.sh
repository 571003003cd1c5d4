# SPDX-License-Identifier: GPL-3.0-or-later
# How each reproduction in shell begins: `. beginning.sh` from a script that was called with PROGRAM FOLDER. It stands in
# the emptied folder then, with `program` in hand and what tests/scripts/runner/saying.sh has. Shared with
# ../known_to_fail.
. "$(dirname "$0")/../scripts/runner/saying.sh"
root=$(cd "$(dirname "$0")/../.." && pwd)
begin "$(readlink -f -- "$1")" "$2"

# Sizes with which something was met, where they take long: whole LONG SHORT.
whole() { if [ -n "${ASPERITY_WHOLE:-}" ]; then echo "$1"; else echo "$2"; fi; }

skip() { echo "$(basename "$0" .sh): $*: skipped"; exit 77; }
