"""Packings of 60 disks on the loudspeaker, as in the laboratory (P 2.4, 3.1)."""
