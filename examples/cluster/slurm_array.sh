#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The cases of a script's ensembles on a cluster with Slurm: a job array computes them, each task its share,
# and a job that waits for the array puts all together in RUN, as a plain run would have.
#
#   examples/cluster/slurm_array.sh SCRIPT STORE RUN TASKS [ROUNDS]     submits everything and returns
#
# STORE is a folder on a disk that all nodes see. A script whose ensembles follow each other needs one round
# for each: give their number as ROUNDS. Slurm may requeue a task at any time: the task goes on in its folder.
# If tasks fail, the last job computes nothing: its log lists the missing cases, and it ends with exit status 3.
# The same command computes what is missing; some tasks alone (here 2 and 5 of 8), and then the whole:
#
#   sbatch --array=2,5 examples/cluster/slurm_array.sh SCRIPT STORE 8
#   asperity run SCRIPT --store STORE --merge-only --resume RUN
#
#SBATCH --job-name=asperity
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=2G
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@120
#SBATCH --output=asperity-%A_%a.log
set -eu
asperity=${ASPERITY:-asperity}

if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
  # One task of the array, started by Slurm. The number of tasks is an argument: Slurm's own variables count only
  # the tasks that were submitted together.
  exec "$asperity" run "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --store "$2" --shard "$SLURM_ARRAY_TASK_ID/$3" \
    --resume "$2/shards/${SLURM_ARRAY_JOB_ID:-0}-$SLURM_ARRAY_TASK_ID"
fi

script=$1 store=$2 run=$3 tasks=$4 rounds=${5:-1}
mkdir -p "$store/shards"
after=
while [ "$rounds" -gt 0 ]; do
  job=$(sbatch --parsable --array="1-$tasks" $after "$0" "$script" "$store" "$tasks")
  after="--dependency=afterany:$job"
  rounds=$((rounds - 1))
done
sbatch $after --job-name=asperity-merge --cpus-per-task=1 --requeue --open-mode=append --signal=B:TERM@120 \
  --output=asperity-merge-%j.log \
  --wrap "exec \"$asperity\" run \"$script\" --store \"$store\" --merge-only --resume \"$run\""
