"""The laboratory of vibrated granular disks on a computer.

An amplifier drives a loudspeaker, the loudspeaker shakes the bottom of a box, the grains in the box push back, two
accelerometers and a camera watch. The grains are an FMU; everything else is here:

    voltage -> loudspeaker -> base displacement, velocity -> FMU -> reaction force -> loudspeaker

    fmu, loudspeaker   the two models          coupling    masters that advance them together
    sensors            what is measured        protocol    what is done to packings, and the results folder
    runs               sweeps and studies      statistics  means, errors, rotation
    demos              three demonstrations    plots       what their pictures share
    film               films of runs

SI units and radians everywhere; x right, y up, angles counter-clockwise positive. The laboratory is that of G. G.
Peraza Mues, "Spontaneous rotation in vibrated disk packings", doctoral thesis, Cinvestav Mérida, 2018, sections 2.4 and
3.1; "P" in docstrings means that thesis.
"""
