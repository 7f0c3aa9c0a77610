"""Demonstrations: a packing on a loudspeaker, a ratchet at constant Gamma, a disk held by torque."""
