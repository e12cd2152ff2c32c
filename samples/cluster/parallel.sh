#!/bin/bash
# Builds all designs of a manifest on several machines, by GNU parallel over ssh.
#
#   parallel.sh MANIFEST HOST... [-- BUILD-OPTIONS]
#
# A HOST is what ssh takes (mill, anna@mill, a name of ~/.ssh/config), or : for this machine. Every host works on one
# share of the manifest at a time, with all its cores, and takes the next one when it is done, so that a fast host does
# more. What a host did not finish is done by another one.
#
# All hosts must see the manifest, its inputs and its outputs under the same path (a shared file system; README.md says
# what to do without one), and must have popupc, perl (for GNU parallel) and a login without a password.
#
# Exit status: 0 all is built; 1 something is missing or failed, STEM.missing.jsonl (.csv) is a manifest of that;
# 2 wrong usage.
#
# POPUPC         the program, by a name that holds on all hosts (popupc)
# SHARES         how many shares there are for each host (4)
# ROUNDS         how often to go over what is missing at most (3)
# PARALLEL_SSH   the command to log in with (ssh, which gives a silent host up after a minute)
set -u

say() { printf 'parallel.sh: %s\n' "$*" >&2; }
usage() {
    say "$1"
    say "usage: parallel.sh MANIFEST HOST... [-- BUILD-OPTIONS]"
    exit 2
}
is_count() { [[ $1 =~ ^[1-9][0-9]{0,8}$ ]]; }
# As one word of the remote shell.
quote() { printf "'%s'" "${1//\'/\'\\\'\'}"; }

[ $# -ge 1 ] || usage "no manifest is named"
[ -f "$1" ] || usage "there is no manifest $1"
manifest=$(realpath "$1")
shift
hosts=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    [[ $1 != -* ]] || usage "options of build stand after --"
    hosts+=("$1")
    shift
done
[ ${#hosts[@]} -gt 0 ] || usage "no host is named"

POPUPC=${POPUPC:-popupc}
SHARES=${SHARES:-4}
ROUNDS=${ROUNDS:-3}
for name in SHARES ROUNDS; do
    is_count "${!name}" || usage "$name is ${!name}, not a number from 1"
done
export PARALLEL_SSH=${PARALLEL_SSH:-ssh -o BatchMode=yes -o ConnectTimeout=20 -o ServerAliveInterval=15 -o ServerAliveCountMax=4}
command -v "$POPUPC" >/dev/null || usage "$POPUPC cannot be run here; POPUPC=… says where popupc is"
[[ $POPUPC != */* ]] || POPUPC=$(realpath "$POPUPC")
command -v parallel >/dev/null || usage "GNU parallel is not installed here (Debian: apt-get install parallel)"

stem=${manifest%.*}
report=$stem.report.json
missing=$stem.missing.${manifest##*.}
joblog=$stem.parallel.log

# shellcheck source=look.sh
. "$(dirname "$(realpath "$0")")/look.sh"

options=
for word in "$@"; do options+=" $(quote "$word")"; done

# A line for each share. Designs that cannot be built (exit status 1) are told by the report, and would not be better on
# another host; everything else is tried there.
commands() {
    local share count=$1
    for ((share = 1; share <= count; share++)); do
        printf 'cd %s || exit 9; %s batch %s --shard %d/%d%s || test $? -eq 1\n' \
            "$(quote "$PWD")" "$(quote "$POPUPC")" "$(quote "$manifest")" "$share" "$count" "$options"
    done
}

# The first round is for all designs, as only popupc batch knows which of those that were built are stale.
look
left=$jobs
for ((round = 1; round <= ROUNDS; round++)); do
    before=$left
    count=$((${#hosts[@]} * SHARES))
    if [ "$count" -gt "$left" ]; then count=$left; fi
    say "round $round: $count shares on ${#hosts[@]} hosts for what is not built of $left designs"
    # --retries: on another host, as long as there is one where the share has not failed yet.
    commands "$count" | parallel --sshloginfile <(printf '%s\n' "${hosts[@]}") --jobs 1 --retries $((${#hosts[@]} + 1)) \
        --joblog "$joblog" --tagstring 'share {#}:' --line-buffer
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
say "not all is built: $report says why, $missing is a manifest of them, $joblog has what ran where"
exit 1
