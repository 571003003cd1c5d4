#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sources whose code differs from a commit compile each by itself, with every warning an error: builds that compile several at
# once do not see an #include that is missing, nor what shadows what. Headers too, by the source of their name where that
# includes them first; and where a header gave up an #include, the sources that include it and find what it included nowhere else.
#
#   alone.sh COMMIT        what differs from the commit, committed or not; of more than 100 sources the newest 100, some three minutes
#   alone.sh --everything  every source
set -euo pipefail
cd "$(dirname -- "$0")/../.."

poorer() {  # sources that include a header which gave up an #include they find nowhere else
  python3 -c 'import sys; sys.path.insert(0, ".ci"); import select_checks as s
print("\n".join(s.poorer_sources(sys.argv[1])))' "$1"
}
other_code() {  # of the files read, those whose code differs from the commit, comments and blanks aside
  python3 -c 'import re, subprocess, sys
def code(text):
    lines = [re.sub(r"\s*//.*", "", " ".join(line.split())) for line in text.splitlines()]
    return [line for line in lines if line]
for path in sys.stdin.read().split():
    old = subprocess.run(["git", "show", sys.argv[1] + ":" + path], capture_output=True, text=True)
    if old.returncode or code(old.stdout) != code(open(path, encoding="utf-8").read()):
        print(path)' "$1"
}
sources() { grep -E '^(engine|bindings|tests|bench)/.*\.(cpp|hpp)$' | grep -v '^bindings/wasm/' || true; }  # emscripten's
if [ "$1" = --everything ]; then
  files=$(git ls-files engine bindings tests bench | sources)
else
  files=$({ git diff --name-only --diff-filter=d --no-renames "$1"; git ls-files --others --exclude-standard; } | sources)
  # shellcheck disable=SC2086  # a list of words
  files=$(printf '%s\n' $files $(poorer "$1") | sources | sort -u | other_code "$1")
fi
# A header whose source is compiled and includes it first is compiled there.
# shellcheck disable=SC2086  # a list of words
files=$(printf '%s\n' $files | while read -r path; do
  source=${path%.hpp}.cpp
  case $path in
    *.hpp)
      ! { printf '%s\n' "$files" | grep -qxF "$source" &&
        [ "$(sed -n '/^#include/ { p; q }' "$source")" = "#include \"$path\"" ]; } || continue
      ;;
  esac
  printf '%s\n' "$path"
done)
[ -n "$files" ] || { echo "no source differs"; exit 0; }
newest=100 count=$(printf '%s\n' "$files" | wc -l)
if [ "$1" != --everything ] && [ "$count" -gt $newest ]; then
  echo "$count sources differ; the newest $newest are compiled"
  files=$({ git diff --name-only HEAD; git ls-files --others --exclude-standard; git log --format= --name-only "$1..HEAD"; } |
    awk '!seen[$0]++' | grep -xF "$files" | sed -n "1,${newest}p")
fi

flags="-std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wno-restrict -Wno-maybe-uninitialized -Wno-unused-const-variable -Werror -DEIGEN_DONT_PARALLELIZE -DOMPI_SKIP_MPICXX
  -DASPERITY_BUILD_FOLDER=\"\" -DASPERITY_PARTS_FOLDER=\"\" -DASPERITY_SOURCE_FOLDER=\"\" -DASPERITY_TEST_DATA=\"\"
  -DASPERITY_PROGRAM=\"\" -DASPERITY_VERSION=\"\" -DASPERITY_BUILD_TYPE=\"\" -DASPERITY_COMPILER=\"\"
  -DASPERITY_FFTW_VERSION=\"\" -DASPERITY_EIGEN_VERSION=\"\" -I. -isystem /usr/include/eigen3"
for package in lua5.4 hdf5-serial libseccomp pugixml libzip; do
  flags="$flags $(pkg-config --cflags "$package" 2> /dev/null | sed 's/-I/-isystem /g')"
done
flags="$flags $(mpicxx --showme:compile 2> /dev/null | sed 's/-I/-isystem /g' || true)"
export flags
compile() {
  case $1 in
    *.hpp) printf '#include "%s"\n' "$1" | c++ $flags -x c++ - ;;
    *) c++ $flags "$1" ;;
  esac || { echo "$1 does not compile by itself"; return 1; }
}
export -f compile
# shellcheck disable=SC2016  # for the shell that xargs starts
printf '%s\n' $files | xargs -P "$(nproc)" -I {} bash -c 'compile {}'
echo "$(printf '%s\n' $files | wc -l) sources compile each by itself"
