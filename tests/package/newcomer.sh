#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a clone to a first chart with the README alone, in a root that holds nothing but Debian: the commands of the
# README, then a script of one's own. The transcript must be the one in docs/newcomer.md, which --write puts there.
# Needs root, mmdebstrap and ten minutes, or one where ccache knows the sources already (CCACHE_DIR); ends with 77 where
# no root can be made.
#
#   tests/package/newcomer.sh FOLDER [--write]
set -euo pipefail
cd "$(dirname -- "$0")/../.."
folder=$1
for place in $(awk -v root="$PWD/$folder/root/" 'index($2, root) == 1 { print $2 }' /proc/mounts); do umount "$place"; done
rm -rf "$folder"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
root=$folder/root
fail() { echo "newcomer: $*" >&2; exit 1; }
. tests/package/debian_root.sh

debian_root "$root" /proc ${CCACHE_DIR:+"$CCACHE_DIR"}
# Where compilations are kept, what was compiled the same way under the same path is not compiled again.
if [ -n "${CCACHE_DIR:-}" ]; then
  chroot "$root" apt-get install -qq -y --no-install-recommends ccache > "$folder/ccache.log" 2>&1 ||
    { cat "$folder/ccache.log"; fail "ccache cannot be installed"; }
fi
clone=$root$PWD
mkdir -p "$clone"
# A copy without its history does as well.
git archive --output="$folder/clone.tar" HEAD || tar -c -f "$folder/clone.tar" --exclude=./build --exclude=./runs .
tar -x -C "$clone" -f "$folder/clone.tar"

cat > "$clone/first.lua" <<'LUA'
-- How does the area of contact grow with the load?
local lab = require "asperity"
local plate = lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="16 um",
                                       material=lab.material "steel" }
local c = lab.contact{ lower=plate, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local book = lab.notebook "area"
for st in c:sweep{ pressure={ "100 MPa", "200 MPa", "400 MPa", "800 MPa", "1600 MPa" } } do
  book:write{ ["pressure [Pa]"]=st.pressure, area=st.area_fraction }
  print(("%5.0f MPa: %4.1f %% touches"):format(st.pressure / 1e6, 100 * st.area_fraction))
end
book:chart{ x="pressure", y="area" }
LUA

# The transcript: each command, and what it says without the noise of package tools and compilers.
kept=()
for name in CCACHE_DIR CCACHE_BASEDIR CCACHE_COMPILERCHECK CMAKE_BUILD_PARALLEL_LEVEL ASPERITY_CMAKE_FLAGS; do
  [ -z "${!name:-}" ] || kept+=("$name=${!name}")
done
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 LC_ALL=C.UTF-8 "${kept[@]}" sh -c "cd '$PWD' && $1"
}
step() {
  printf '\n```console\n$ %s\n' "$1"
  inside "$1" > "$folder/step.log" 2>&1 || { cat "$folder/step.log" >&2; fail "$1"; }
  grep -vE '^(Selecting|Preparing|Unpacking|Setting up|Processing|Get:|Fetched|Reading|Building|\(Reading|-- |debconf:|\[ *[0-9]+%\]|Preset|$)' "$folder/step.log" |
    grep -vE '^ {2}[A-Z]+=|^Preconfig|^update-alternatives|^invoke-rc.d|^Extracting|^Created symlink|% done:|about .* left$' |
    grep -vx store |  # a folder of results that took over ten milliseconds, where any did
    sed "s|$PWD|/root/asperity|g" | tail -n "${2:-25}"
  printf '```\n'
}
{
  echo "# From a clone to a first chart"
  echo
  echo "You have a machine with Debian 12 and nothing else, and you have read the README. \`tests/package/newcomer.sh\` recorded this"
  echo "page, without the messages of package tools and compilers."
  step "./lab demo" 2
  printf '\nYour own script, `first.lua`:\n\n```lua\n'
  cat "$clone/first.lua"
  printf '```\n'
  step "./lab run first.lua" 6
  step "ls runs/first-1"
  printf '\nThe chart, `runs/first-1/%s`:\n\n![Area of contact against pressure](pictures/newcomer.svg)\n' \
    "$(basename "$clone"/runs/first-1/*.svg)"
} > "$folder/newcomer.md"
cp "$clone"/runs/first-1/*.svg "$folder/newcomer.svg"

if [ "${2:-}" = --write ]; then
  cp "$folder/newcomer.svg" docs/pictures/newcomer.svg
  cp "$folder/newcomer.md" docs/newcomer.md
  echo "newcomer: wrote docs/newcomer.md"
else
  diff -u docs/newcomer.md "$folder/newcomer.md" || fail "docs/newcomer.md tells another story; --write renews it"
  echo "newcomer: a first chart was drawn, as docs/newcomer.md tells"
fi
