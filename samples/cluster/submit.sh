#!/bin/bash
# Builds all designs of a manifest on a Slurm cluster, and ends when that is done.
#
#   submit.sh MANIFEST [TASKS] [-- BUILD-OPTIONS]
#
# Submits slurm-array.sh as an array of TASKS tasks, waits for it, joins the results to STEM.report.json beside the
# manifest, and submits again as long as something is missing and a round has mended something. TASKS may carry Slurm's
# limit of tasks that run at a time (200%50); without TASKS there is one for every PER_TASK designs.
#
# Ending it with Ctrl-C cancels the array. If the connection is lost the array goes on; the same command then waits for
# it and does not submit another. Nothing that was built is built again.
#
# Exit status: 0 all is built; 1 something is missing or failed, STEM.missing.jsonl (.csv) is a manifest of that;
# 2 wrong usage, or Slurm takes no jobs.
#
# POPUPC     the program, by a name that holds on all nodes (popupc)
# PER_TASK   designs a task, to last some ten minutes (500)
# ROUNDS     how often to submit at most (5)
# POLL       seconds between two looks at the queue (15)
# SBATCH_…   whatever sbatch knows: SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT, SBATCH_CPUS_PER_TASK …
set -u

say() { printf 'submit.sh: %s\n' "$*" >&2; }
usage() {
    say "$1"
    say "usage: submit.sh MANIFEST [TASKS] [-- BUILD-OPTIONS]"
    exit 2
}
is_count() { [[ $1 =~ ^[1-9][0-9]{0,8}$ ]]; }

[ $# -ge 1 ] || usage "no manifest is named"
[ -f "$1" ] || usage "there is no manifest $1"
manifest=$(realpath "$1")
shift
tasks=
limit=
if [ $# -gt 0 ] && [ "$1" != -- ]; then
    tasks=${1%%\%*}
    limit=${1#"$tasks"}
    is_count "$tasks" || usage "the number of tasks is $1, not a number from 1"
    [ -z "$limit" ] || is_count "${limit#%}" || usage "the limit of tasks at a time is $limit, not % and a number from 1"
    shift
fi
[ $# -eq 0 ] || [ "$1" = -- ] || usage "options of build stand after --"

POPUPC=${POPUPC:-popupc}
PER_TASK=${PER_TASK:-500}
ROUNDS=${ROUNDS:-5}
POLL=${POLL:-15}
for name in PER_TASK ROUNDS POLL; do
    is_count "${!name}" || usage "$name is ${!name}, not a number from 1"
done
command -v "$POPUPC" >/dev/null || usage "$POPUPC cannot be run here; POPUPC=… says where popupc is"
[[ $POPUPC != */* ]] || POPUPC=$(realpath "$POPUPC")
export POPUPC
for program in sbatch squeue scancel scontrol; do
    command -v "$program" >/dev/null || usage "$program is not installed here: submit from a node that has Slurm's commands"
done

array_script=$(dirname "$(realpath "$0")")/slurm-array.sh
stem=${manifest%.*}
report=$stem.report.json
missing=$stem.missing.${manifest##*.}
logs=$stem.logs
# By its name the array is found again.
job_name=popupc-$(printf '%s' "$manifest" | cksum | cut -d ' ' -f 1)

# Indices of an array are below MaxArraySize.
most=$(scontrol show config 2>/dev/null | sed -n 's/^MaxArraySize *= *\([0-9]*\).*/\1/p')
most=$((${most:-1001} - 1))
if [ "$most" -lt 1 ]; then most=1; fi
[ -z "$tasks" ] || [ "$tasks" -le "$most" ] || usage "$tasks tasks are more than the $most that this Slurm takes in an array"

# shellcheck source=look.sh
. "$(dirname "$(realpath "$0")")/look.sh"

# What the tasks of an array do: "3 running, 9 pending (Resources)". Empty when it has ended; fails when Slurm gives no
# answer, which may change.
state_of() {
    local lines
    if ! lines=$(squeue -h -r -j "$1" -o '%T %r' 2>&1); then
        # An array that ended a while ago is unknown to Slurm.
        [[ $lines == *"Invalid job id"* ]]
        return
    fi
    printf '%s\n' "$lines" | awk '
        NF == 0 { next }
        { what = tolower($1) }
        what == "pending" { sub(/^[^ ]+ /, ""); what = what " (" $0 ")" }
        !(what in count) { order[++kinds] = what }
        { count[what]++ }
        END { for (i = 1; i <= kinds; i++) printf "%s%d %s", (i > 1 ? ", " : ""), count[order[i]], order[i] }'
}

# Waits until no task of the array is in the queue.
wait_for() {
    local seen="" state
    while :; do
        if ! state=$(state_of "$1"); then
            state="squeue gives no answer; trying again"
        elif [ -z "$state" ]; then
            return
        fi
        if [ "$state" != "$seen" ]; then
            say "job $1: $state"
            if [[ $state == *requeued?held* ]]; then
                say "its node could not start a task; when that is mended: scontrol release $1"
            fi
            seen=$state
        fi
        sleep "$POLL" &
        wait $!
    done
}

job=
# shellcheck disable=SC2317  # called by the trap
cancel() {
    trap - INT TERM
    jobs -p | xargs -r kill
    if [ -n "$job" ]; then
        say "cancelling job $job; the same command takes up what is missing"
        scancel "$job"
    fi
    exit 130
}
trap cancel INT TERM

job=$(squeue -h -u "$(id -un)" -n "$job_name" -o %F 2>/dev/null | sort -n | tail -n 1)
if [ -n "$job" ]; then
    say "job $job builds this manifest already; waiting for it"
    wait_for "$job"
    job=
fi

# The first round is for all designs, as only popupc batch knows which of those that were built are stale.
look
left=$jobs
mkdir -p "$logs" || exit 2
for ((round = 1; round <= ROUNDS; round++)); do
    before=$left
    count=${tasks:-$(((left + PER_TASK - 1) / PER_TASK))}
    if [ "$count" -gt "$left" ]; then count=$left; fi
    if [ "$count" -gt "$most" ]; then count=$most; fi
    job=$(sbatch --parsable --job-name="$job_name" --array="1-$count$limit" --output="${logs//%/%%}/%A_%a.log" \
        "$array_script" "$manifest" "$@") || exit 2
    job=${job%%;*}
    say "round $round: job $job of $count tasks for what is not built of $left designs"
    wait_for "$job"
    job=
    if look; then
        say "all is built"
        exit 0
    fi
    [ "$left" -gt 0 ] || break
    # The first round may have met a bad hour; one that mends nothing will be followed by others alike.
    if [ "$round" -gt 1 ] && [ "$left" -ge "$before" ]; then
        say "round $round mended nothing"
        break
    fi
done
"$POPUPC" merge-reports "$manifest"
say "not all is built: $report says why, $missing is a manifest of them, $logs has what the tasks said"
exit 1
