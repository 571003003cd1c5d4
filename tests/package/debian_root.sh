# SPDX-License-Identifier: GPL-3.0-or-later
# A root that holds nothing but Debian, for what must be tried on a bare machine; sourced by the scripts beside it.

# debian_root ROOT [MOUNTED]: makes one and, where MOUNTED is said, mounts /proc in it until the script ends. Ends the
# script with 77 where this machine lets none be made: that says nothing of the project.
debian_root() {
  [ "$(id -u)" = 0 ] || left_out "only root can enter a root of its own"
  mmdebstrap --quiet --variant=apt bookworm "$1" || left_out "mmdebstrap could not make a root of Debian here"
  chroot "$1" apt-get update -qq -o APT::Update::Error-Mode=any || left_out "Debian's archive is out of the root's reach"
  if [ "${2:-}" = mounted ]; then
    mount --bind /proc "$1/proc" || left_out "this machine lets nothing be mounted"
    # shellcheck disable=SC2064  # the root of now
    trap "umount '$1/proc'" EXIT
  fi
}

left_out() {
  echo "$(basename "$0" .sh): left out: $*" >&2
  exit 77
}
