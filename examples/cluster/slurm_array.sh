#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The cases of a script's ensembles on a cluster with Slurm: a job array computes them, each task its share,
# and a job that waits for the array puts all together in RUN, as a plain run would have.
#
#   examples/cluster/slurm_array.sh SCRIPT STORE RUN TASKS [ROUNDS]     submits everything and returns
#
# STORE is a folder on a disk that all nodes see. A script whose ensembles follow each other needs one round
# for each: give their number as ROUNDS. Tasks that were killed are run again by the same command: what is in
# STORE is not computed twice.
#SBATCH --job-name=asperity
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --output=asperity-%A_%a.log
set -eu
asperity=${ASPERITY:-asperity}

if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
  # One task of the array, started by Slurm.
  exec "$asperity" run "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --store "$2" --shard slurm \
    --out "$2/shards/${SLURM_ARRAY_JOB_ID:-0}-$SLURM_ARRAY_TASK_ID"
fi

script=$1 store=$2 run=$3 tasks=$4 rounds=${5:-1}
mkdir -p "$store/shards"
after=
while [ "$rounds" -gt 0 ]; do
  job=$(sbatch --parsable --array="1-$tasks" $after "$0" "$script" "$store")
  after="--dependency=afterok:$job"
  rounds=$((rounds - 1))
done
sbatch $after --job-name=asperity-merge --cpus-per-task=1 \
  --wrap "\"$asperity\" run \"$script\" --store \"$store\" --out \"$run\""
