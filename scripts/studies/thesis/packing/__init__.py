"""Packings of 60 disks (P 3)."""
