"""One disk on two supports (P 5)."""
