"""Masters that advance the loudspeaker and the grains together, their comparison, and the control of their steps."""
