# SPDX-License-Identifier: GPL-3.0-or-later
# What the tests in shell share: `. saying.sh` from a script beside it. Sourced before any `cd`.

# begin PROGRAM FOLDER ...: the program, and an empty folder to work in.
begin() {
  program=$1 folder=$2
  rm -rf "$folder"
  mkdir -p "$folder"
  cd "$folder"
}

fail() { echo "$(basename "$0" .sh): $*" >&2; exit 1; }

# status text command...: the command ends so, and prints that.
ends() {
  wanted=$1 text=$2
  shift 2
  status=0
  "$@" > output 2>&1 || status=$?
  [ "$status" = "$wanted" ] || { cat output; fail "$* ended with $status instead of $wanted"; }
  grep -qF -- "$text" output || { cat output; fail "$* did not print: $text"; }
}

# until_true command...: waits for it. Ten minutes count as a hang.
until_true() {
  hang=$(($(date +%s) + 600))
  until "$@" > /dev/null 2>&1; do
    [ "$(date +%s)" -lt $hang ] || fail "$* never came true"
    sleep 0.02
  done
}

# text file: the text is in the file.
says() { grep -qF -- "$1" "$2" || { cat "$2"; fail "$2 does not say: $1"; }; }
