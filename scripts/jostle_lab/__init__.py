"""The laboratory of vibrated granular disks on a computer.

An amplifier drives a loudspeaker, the loudspeaker shakes the bottom of a box, the grains in the box push back, two
accelerometers and a camera watch. The grains are an FMU; everything else is here:

    voltage -> loudspeaker -> base displacement, velocity -> FMU -> reaction force -> loudspeaker

SI units and radians everywhere; x right, y up, angles counter-clockwise positive. The laboratory is that of
P 2.4 and 3.1. "P" in docstrings means G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral
thesis, Cinvestav Mérida, 2018.
"""
