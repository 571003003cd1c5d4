# SPDX-License-Identifier: GPL-3.0-or-later
# What the tests over mpirun share: `. mpi_ranks.sh` from a script beside it, after saying.sh and a `cd` to the folder
# that the test may fill; $program is the program. Exits with 77, skipped, where there is no mpirun or no asperity-mpi.so.

skip() { echo "$(basename "$0" .sh): $*: skipped"; exit 77; }

command -v mpirun > /dev/null 2>&1 || skip "there is no mpirun here"
[ -f "$(dirname "$program")/asperity-mpi.so" ] || skip "built without MPI"

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export TMPDIR="$PWD"
# Open MPI looks for a way to other machines first, though there are none here.
command -v ssh > /dev/null 2>&1 || export OMPI_MCA_plm_rsh_agent=true
# Ranks that wait let others have the processor: other tests run beside these.
export OMPI_MCA_mpi_yield_when_idle=1

# ranks count command...
ranks() { count=$1; shift; timeout -k 5 1200 mpirun --oversubscribe --bind-to none -n "$count" "$@"; }

# processes_of RANK TEXT: those that run as this rank (a pattern) with the text in their command.
processes_of() {
  for process in /proc/[0-9]*; do
    if tr '\0' '\n' 2> /dev/null < "$process/environ" | grep -q "^OMPI_COMM_WORLD_RANK=$1\$" &&
      tr '\0' ' ' 2> /dev/null < "$process/cmdline" | grep -q -- "$2"; then
      echo "${process#/proc/}"
    fi
  done
}

# ends_soon how command...: two ranks of a run of long.lua, written to the directory `how`, are interrupted
# ("interrupt") or one of them is killed ("kill") once the command succeeds; the run ends, and not well. A run that does not
# end meets the limit of the test. What they say is in how.txt.
ends_soon() {
  how=$1
  shift
  # mpirun waits so many seconds before SIGTERM and again before SIGKILL, whatever has ended meanwhile. One, its default,
  # is short for a rank that records where it was interrupted while the machine builds something. A load of 4 gives 13 s.
  patience=1
  [ "$how" != interrupt ] || patience=$((5 + 2 * $(cut -d. -f1 /proc/loadavg)))
  OMPI_MCA_odls_base_sigkill_timeout=$patience mpirun --oversubscribe --bind-to none -n 2 \
    "$program" run long.lua --threads 1 --out "$how" > "$how.txt" 2>&1 &
  launcher=$!
  (until_true "$@") || { cat "$how.txt"; fail "$how: did not begin"; }
  if [ "$how" = interrupt ]; then
    kill -INT $launcher
  else
    victim=$(processes_of 1 "long.lua.*--out kill")
    [ -n "$victim" ] || { cat "$how.txt"; fail "$how: rank 1 has ended by itself"; }
    kill -9 $victim
  fi
  wait $launcher && fail "$how: the run ended well" || true
}
