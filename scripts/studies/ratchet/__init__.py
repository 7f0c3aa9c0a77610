"""F computed anew: what F states of the ratchet beside what the simulation gives.

    figure -> cases -> runs, kept in a record -> velocities of single runs -> statements -> docs/generated/claims.md

"F" in docstrings means Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, "Transitions in the horizontal transport of
vertically vibrated granular layers", Phys. Rev. E 60, 7022 (1999). Velocities are in cm/s, as there.
"""
