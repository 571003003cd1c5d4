#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Help finds parts of names and words of sentences.
set -eu
. "$(dirname "$0")/beginning.sh"
for topic in tilt:tilt_stage rough:roughness stiff:stiffness plastic:effects.plasticity Sq:roughness mu:raise \
  trials:raise half_space:effects.elasticity x3p:surface.read box:effects.elasticity; do
  ends 0 "${topic#*:}" "$program" help "${topic%:*}"
done
