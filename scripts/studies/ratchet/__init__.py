"""F IV anew: what Farkas et al. say of the ratchet, beside what it does here.

    figure -> cases -> sweep -> velocities of single runs -> statements -> docs/ratchet.md

"F" in docstrings means Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, "Transitions in the horizontal transport of
vertically vibrated granular layers" (2002). Velocities are in cm/s, as there. One more thing is here: a shaker whose
controller holds Gamma (`shaker`, `controller`, `demo`).
"""
