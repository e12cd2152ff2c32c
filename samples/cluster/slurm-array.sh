#!/bin/bash
# One task of a Slurm job array: its share of the designs of a manifest.
#
#   sbatch --array=1-20 slurm-array.sh MANIFEST [-- BUILD-OPTIONS]
#
# submit.sh submits this, waits, and submits again what is missing. By hand, sbatch's own options and its SBATCH_…
# variables (SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT …) go before what stands below. POPUPC says where
# popupc is if it is not on the PATH of the nodes.
#
# A share that was stopped, by whatever, is taken up where it was: popupc does only what is missing.
#SBATCH --job-name=popupc
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
# Some 20 MB are needed for each core; designs with large pictures, or nested tightly, need more.
#SBATCH --mem-per-cpu=512M
# For shares of ten minutes. What is not done by then is left to the next round.
#SBATCH --time=01:00:00
# When a node dies, Slurm starts its tasks again on another; their logs are continued.
#SBATCH --requeue
#SBATCH --open-mode=append
set -eu

if [ $# -lt 1 ] || { [ $# -gt 1 ] && [ "$2" != -- ]; }; then
    echo "usage: sbatch --array=1-N slurm-array.sh MANIFEST [-- BUILD-OPTIONS]" >&2
    exit 2
fi
if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
    echo "slurm-array.sh: this is no task of an array: use sbatch --array=1-N, or submit.sh" >&2
    exit 2
fi
manifest=$1
shift

echo "slurm-array.sh: task $SLURM_ARRAY_TASK_ID of ${SLURM_ARRAY_TASK_COUNT:-?} on ${SLURMD_NODENAME:-this node}," \
    "started ${SLURM_RESTART_COUNT:-0} times before"
# popupc reads its share from SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT. With exec it is popupc itself that Slurm
# tells to end.
exec "${POPUPC:-popupc}" batch "$manifest" -j "${SLURM_CPUS_PER_TASK:-1}" "$@"
