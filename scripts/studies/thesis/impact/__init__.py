"""One impact of a disk with elastic, viscous and frictional contact (P 4.5)."""
