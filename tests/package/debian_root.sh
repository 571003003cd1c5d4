# SPDX-License-Identifier: GPL-3.0-or-later
# A root that holds nothing but Debian, for what must be tried on a bare machine; sourced by the scripts beside it.

# debian_root ROOT [MOUNTED..]: makes one and mounts what is said after it at the same place there, until the script ends.
# Debian itself is unpacked once, into build/debian.tar, if it is not a day old. Ends the script with 77 where this
# machine lets none be made: that says nothing of the project.
debian_root() {
  local root=$1 archive=build/debian.tar place
  shift
  [ "$(id -u)" = 0 ] || left_out "only root can enter a root of its own"
  if [ -z "$(find "$archive" -mtime -1 2> /dev/null)" ]; then
    rm -rf "$root"
    mmdebstrap --quiet --variant=apt bookworm "$root" || left_out "mmdebstrap could not make a root of Debian here"
    chroot "$root" apt-get update -qq -o APT::Update::Error-Mode=any || left_out "Debian's archive is out of the root's reach"
    mkdir -p build
    tar -c -f "$archive.part" -C "$root" --exclude=./proc/* --exclude=./sys/* . && mv "$archive.part" "$archive"
  else
    mkdir -p "$root"
    tar -x -f "$archive" -C "$root"
  fi
  mounted=
  trap 'for place in $mounted; do umount "$place"; done' EXIT
  for place in "$@"; do
    mkdir -p "$root$place"
    mount --bind "$place" "$root$place" || left_out "this machine lets nothing be mounted"
    mounted="$root$place $mounted"
  done
}

left_out() {
  echo "$(basename "$0" .sh): left out: $*" >&2
  exit 77
}
