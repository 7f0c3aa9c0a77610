"""One disk in a wedge (P 6)."""
