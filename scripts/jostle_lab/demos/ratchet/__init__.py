"""A shaker whose controller holds Gamma while it sweeps the frequency under a ratchet."""
