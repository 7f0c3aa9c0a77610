"""Masters that advance the loudspeaker and the grains together, and their comparison."""
