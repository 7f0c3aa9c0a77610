"""What the experimenter sees: accelerometers on the base, the spectral estimate of the drive, a camera."""
