# Sourced by the scripts beside it: one way to speak, one way to fail.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"

say() { printf '== %s\n' "$*"; }

# fail WHAT REMEDY
fail() {
    printf 'error: %s\n       %s\n' "$1" "$2" >&2
    exit 1
}

# need COMMAND REMEDY
need() { command -v "$1" >/dev/null || fail "$1 is not installed." "$2"; }

# descendants PID: the process, and all that it and they have started.
descendants() {
    local child children
    echo "$1"
    children="$(cat /proc/"$1"/task/*/children 2>/dev/null || pgrep -P "$1" || true)"
    for child in $children; do descendants "$child"; done
}

# stoppably COMMAND...: as COMMAND, but Ctrl-C, SIGTERM and a closed terminal end at once all that it has started.
stoppably() {
    local job status=0
    "$@" &
    job=$!
    trap 'end_all "$job" 129' HUP
    trap 'end_all "$job" 130' INT
    trap 'end_all "$job" 143' TERM
    wait "$job" || status=$?
    trap - HUP INT TERM
    return "$status"
}

# end_all PID STATUS: part of stoppably.
end_all() {
    local all
    trap '' HUP INT TERM
    all="$(descendants "$1")"
    # shellcheck disable=SC2086 - several numbers
    kill -TERM $all 2>/dev/null || true
    wait "$1" 2>/dev/null || true
    printf 'stopped. What is built already is kept; the same command goes on from there.\n' >&2
    exit "$2"
}

# The toolchain that rust-toolchain.toml names, or the installed default if that is as new: rustup then fetches nothing.
use_installed_rust() {
    local named installed default version
    named="$(sed -n 's/^channel = "\(.*\)"/\1/p' rust-toolchain.toml)"
    [[ -z "${RUSTUP_TOOLCHAIN:-}" ]] && command -v rustup >/dev/null || return 0
    installed="$(rustup toolchain list 2>/dev/null)" || return 0
    ! grep -q "^$named" <<<"$installed" || return 0
    default="$(awk '/default/ { print $1; exit }' <<<"$installed")"
    [[ -n "$default" ]] || return 0
    version="$(rustup run "$default" rustc --version 2>/dev/null | cut -d ' ' -f 2)"
    [[ "$(printf '%s\n' "$named" "$version" | sort -V | head -n 1)" != "$named" ]] || export RUSTUP_TOOLCHAIN="$default"
}
use_installed_rust

# quietly WHAT REMEDY COMMAND...: shows the output only if the command fails.
quietly() {
    local what="$1" remedy="$2" output
    shift 2
    if ! output="$("$@" 2>&1)"; then
        printf '%s\n' "$output" >&2
        fail "$what" "$remedy"
    fi
}
