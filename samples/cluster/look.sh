# What submit.sh and parallel.sh share: how far the batch of "$manifest" is. To be sourced by bash.
# shellcheck shell=bash disable=SC2034,SC2154  # what it sets is for them, and the names of files are theirs

# Joins the results. Sets `jobs` to the number of designs, and `left` to how many another run may build: not those that
# have errors. Fails when not all is built.
jobs=
left=
look() {
    local said status
    rm -f "$report"
    said=$("$POPUPC" merge-reports "$manifest" -o "$report" --missing "$missing" 2>&1)
    status=$?
    if [ ! -f "$report" ]; then
        printf '%s\n' "$said" >&2
        exit 2
    fi
    # The counts stand before the results.
    jobs=$(sed -n 's/^  "jobs": \([0-9]*\).*/\1/p; 9q' "$report")
    left=$(awk '/^  "(unusable|crashed|missing|gone)":/ { sum += $2 } NR == 9 { exit } END { print sum + 0 }' "$report")
    [ "$status" -ne 0 ] || rm -f "$missing"
    return "$status"
}
