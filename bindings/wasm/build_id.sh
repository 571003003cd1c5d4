#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# build_id.sh OUTPUT ARCHIVE..: writes the SHA-1 of the libraries as a C++ source.
set -eu
output=$1
shift
bytes=$(cat "$@" | sha1sum | cut -c1-40 | sed 's/../0x&,/g')
echo "extern const unsigned char asperity_build_id[20]; const unsigned char asperity_build_id[20] = {$bytes};" >"$output"
