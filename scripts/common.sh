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

# quietly WHAT REMEDY COMMAND...: shows the output only if the command fails.
quietly() {
    local what="$1" remedy="$2" output
    shift 2
    if ! output="$("$@" 2>&1)"; then
        printf '%s\n' "$output" >&2
        fail "$what" "$remedy"
    fi
}
