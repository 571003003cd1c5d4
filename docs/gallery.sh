#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes docs/gallery.md and docs/pictures/gallery: a picture of every example and every lesson, with the question it
# answers and the command that makes it. The pictures are what the scripts drew, copied and not touched.
# usage: gallery.sh PROGRAM [RUNS]   run them all (minutes), then write; runs that lie in the folder RUNS are taken
#        gallery.sh --check FOLDER   is the page of the project's FOLDER what the scripts say, with every picture there?
set -eu

# script without its folder and ending : the picture of it
pictures='
quick_start:events-Ra-N.svg
fig1_grain:grain_1.3.png
fig2_surface:fig2_profiles.svg
fig3_stress:fig3_Ra.svg
fig4_events:fig4_Ra_bead-blasted.svg
fig5_dimension:fig5_events.svg
fig6_correlation:fig6_bead-blasted.svg
fig7_tilt:fig7_events.svg
fig8a_stiffness:fig8a_stiffness.svg
fig8b_friction:fig8b_friction.svg
fig9_flattening:fig9_flattening.svg
rotation_memory:slope_by_contacts.svg
rough_on_rough:rough_on_rough.svg
how_bodies_give_way:areas.svg
stylus_and_tip:stylus-and-tip-slope_kept-tip.svg
worn_pair:lost.svg
angles:angles.svg
measured_specimen:pressure.png
replay_press_log:press_log.svg
calibrate_tilt:calibration.svg
budget_of_fig7:rises.svg
01_roughness:lines.svg
02_fractal_dimension:stretched.svg
03_boxes_and_half_space:hills.svg
04_real_area:area.svg
05_turning:on_quartz.svg
06_tilt:angles.svg
07_accuracy:ways.svg
08_press_log:volume.svg
09_same_numbers:touching.svg
10_own_data:D.svg'

scripts() { find examples scripts/lessons -name '*.lua' ! -path 'examples/accuracy/*' ! -path 'examples/data/*' ! -path 'examples/library/*'; }
path_of() { scripts | grep "/$1\.lua\$"; }
kept() { printf '%s.%s' "$1" "${2##*.}"; }

page() {
  cat <<'TEXT'
# Gallery

<!-- Written by docs/gallery.sh; do not edit. -->

The pictures of the examples and lessons, each with its question and its command. Nothing was drawn by hand or retouched.
TEXT
  printf '\n## Examples\n'
  lessons=
  for entry in $pictures; do
    name=${entry%%:*} picture=${entry#*:}
    path=$(path_of "$name")
    case $path in
      scripts/lessons/*)
        [ -n "$lessons" ] || printf '\n## Lessons\n'
        lessons=yes
        question=$(sed -n '/^-- Question: /,/^-- Predict: /{s/^-- Question: //;/^-- Predict: /!{s/^-- *//;p}}' "$path" | tr '\n' ' ')
        command="asperity lesson ${name#*_} --run"
        ;;
      *)
        question=$(sed -n '2s/^-- //p' "$path")
        command="asperity run $path"
        ;;
    esac
    printf '\n### %s\n\n![%s](pictures/gallery/%s)\n\n`%s`\n' "${question% }" "${question% }" "$(kept "$name" "$picture")" "$command"
  done
}

if [ "${1:-}" = --check ]; then
  cd "$2"
  status=0
  for path in $(scripts); do
    name=$(basename -- "$path" .lua)
    case $pictures in
      *"
$name:"*) ;;
      *) echo "docs/gallery.sh has no picture of $path" && status=1 ;;
    esac
  done
  for entry in $pictures; do
    picture=docs/pictures/gallery/$(kept "${entry%%:*}" "${entry#*:}")
    [ -s "$picture" ] || { echo "$picture is missing: run docs/gallery.sh PROGRAM" && status=1; }
  done
  for picture in docs/pictures/gallery/*; do
    grep -qF "(pictures/gallery/$(basename -- "$picture"))" docs/gallery.md || { echo "$picture is on no page" && status=1; }
  done
  written=$(mktemp)
  trap 'rm -f "$written"' EXIT
  page >"$written"
  diff -u --label "docs/gallery.md as it stands" --label "as docs/gallery.sh writes it" docs/gallery.md "$written" || status=1
  [ $status = 0 ] && echo "the gallery shows every example and every lesson"
  exit $status
fi

[ $# -ge 1 ] || {
  echo "usage: gallery.sh PROGRAM [RUNS]" >&2
  exit 2
}
program=$(readlink -f -- "$1")
made=
[ -n "${2:-}" ] || made=$(mktemp -d)
runs=$(readlink -f -- "${2:-$made}")
trap '[ -z "$made" ] || rm -rf "$made"' EXIT
cd "$(dirname -- "$(readlink -f -- "$0")")/.."
rm -rf docs/pictures/gallery
mkdir -p docs/pictures/gallery
for entry in $pictures; do
  name=${entry%%:*} picture=${entry#*:}
  [ -d "$runs/$name" ] || {
    echo "$name" >&2
    "$program" run --out "$runs/$name" "$(path_of "$name")" >/dev/null
  }
  cp "$runs/$name/$picture" "docs/pictures/gallery/$(kept "$name" "$picture")"
done
page >docs/gallery.md
