#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run on a file system whose power is cut, without its journal written, some time after the run ended, and on the
# way. What says `done` is whole then; all else is taken up to the same bytes. Needs root, a loop device and ext4;
# exit status 77 where one of them is not to be had.
#
#   tests/scripts/runner/power_cut.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
program=$1
folder=$2
skip() { echo "power_cut: $*: skipped"; exit 77; }
[ "$(id -u)" = 0 ] || skip "only root can cut the power of a file system"
for tool in mkfs.ext4 mount umount losetup python3; do
  command -v $tool > /dev/null 2>&1 || skip "there is no $tool"
done
umount "$folder/m" 2> /dev/null || true
rm -rf "$folder"
mkdir -p "$folder/m"
cd "$folder"
truncate -s 64M image
mkfs.ext4 -q image 2> /dev/null || skip "no ext4 can be made here"
mount -o loop image m 2> /dev/null || skip "no file system can be mounted here"
trap 'cd /; umount "$folder/m" 2> /dev/null || true' EXIT

# EXT4_IOC_SHUTDOWN with EXT4_GOING_FLAGS_NOLOGFLUSH: what is not on the disk never comes there.
cut_power() {
  python3 -c "import fcntl, os, struct; fcntl.ioctl(os.open('m', 0), 0x8004587d, struct.pack('I', 2))" ||
    skip "this kernel does not shut a file system down"
  umount m
  mount -o loop image m
}

cat > short.lua <<'LUA'
local lab = require "asperity"
local function body(seed)
  return lab.surface.self_affine{ cells = 64, size = "1 mm", hurst = 0.8, ra = "1 um", short_wave = "60 um", seed = seed,
    material = lab.material "Al-2011" }
end
local c = lab.contact{ lower = body(1), upper = body(2), boundary = "periodic", effects = { elasticity = "half_space" } }
local book = lab.notebook "n"
for k = 1, 6 do
  local st = c:press{ pressure = k * 1e6 }
  book:write{ k = k, area = st.area_fraction }
  if k == 3 then st:write "maps/x.h5" end
end
book:chart{ x = "k", y = "area", file = "n.svg" }
body(3):write "z.npy"
LUA
files="script.lua n.csv n.svg z.npy maps/x.h5 maps/x.xdmf"
"$program" run short.lua --out plain 2> /dev/null
same() {
  for file in $files; do cmp plain/$file $1/$file || fail "$file of $1, $2"; done
}

# At once after the end, and after some seconds, when metadata is on the disk and content may not be.
for seconds in 0 1 6; do
  "$program" run short.lua --out m/run-$seconds 2> /dev/null
  sleep $seconds
  cut_power
  grep -q '"status": "done"' m/run-$seconds/manifest.json || fail "after $seconds s: the run is not done"
  same m/run-$seconds "cut after $seconds s"
  ends 0 "there is nothing to resume" "$program" run --resume m/run-$seconds
done

# On the way.
for tenths in 0 1 2 3 4 5 6; do
  "$program" run short.lua --out m/way-$tenths > /dev/null 2>&1 &
  process=$!
  sleep 0.0$tenths
  cut_power_of=$process
  python3 -c "import fcntl, os, struct; fcntl.ioctl(os.open('m', 0), 0x8004587d, struct.pack('I', 2))"
  wait $cut_power_of 2> /dev/null || true
  umount m
  mount -o loop image m
  "$program" run short.lua --resume m/way-$tenths > output 2>&1 || { ls -la m/way-$tenths; cat output; fail "cut on the way"; }
  same m/way-$tenths "cut on the way"
done
echo "power_cut: all is well"
