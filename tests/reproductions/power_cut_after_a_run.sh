#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The power of a disk is cut shortly after the end of a run. All files of a manifest with status done are whole.
# Only root can cut it; runner/power_cut.sh tries more moments.
set -eu
. "$(dirname "$0")/beginning.sh"
[ "$(id -u)" = 0 ] || skip "only root can cut the power of a file system"
for tool in mkfs.ext4 mount umount losetup python3; do
  command -v $tool > /dev/null 2>&1 || skip "there is no $tool"
done
mkdir m
truncate -s 120M i
mkfs.ext4 -q i 2> /dev/null || skip "no ext4 can be made here"
mount -o loop i m 2> /dev/null || skip "no file system can be mounted here"
trap 'cd /; umount "$folder/m" 2> /dev/null || true' EXIT
cat > short.lua <<'LUA'
local lab = require "asperity"
local function body(seed)
  return lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, ra="1 um", short_wave="16 um", seed=seed,
    material=lab.material "Al-2011" }
end
local c = lab.contact{ lower=body(1), upper=body(2), boundary="periodic", effects={ elasticity="half_space" } }
local book = lab.notebook "n"
for k = 1, 6 do
  local st = c:press{ pressure=k * 1e6 }
  book:write{ k=k, area=st.area_fraction }
  if k > 4 then
    st:field "pressure":picture("p" .. k .. ".png")
    st:write("x" .. k .. ".h5")
  end
end
book:chart{ x="k", y="area", file="n.svg" }
LUA
"$program" run --out m/run short.lua 2> /dev/null
cp -r m/run as-written
sleep $(whole 7 1)
python3 -c "import fcntl, os, struct; fcntl.ioctl(os.open('m', 0), 0x8004587d, struct.pack('I', 2))" ||
  skip "this kernel does not shut a file system down"
umount m
mount -o loop i m
says '"status": "done"' m/run/manifest.json
for file in journal.jsonl n.csv n.svg p5.png p6.png x5.h5 x6.h5 x5.xdmf x6.xdmf script.lua; do
  cmp as-written/$file m/run/$file || fail "$file after the cut"
done
ends 0 "there is nothing to resume" "$program" run --resume m/run
