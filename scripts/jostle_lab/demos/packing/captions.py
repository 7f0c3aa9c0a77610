"""What is said beside each picture of the page: what is seen, what to look at, what it means."""

from typing import NamedTuple


class Caption(NamedTuple):
    """A picture and its words."""

    file: str
    title: str
    alt: str
    see: str
    look: str
    means: str
    version: str = ""
    """Behind the name, so that a browser does not show the picture of before."""


NOW = Caption(
    "packing_now.png",
    "The first packing, now",
    "Disks in a box, coloured by their mean angular velocity in the last seconds: red clockwise, blue "
    "counter-clockwise",
    "The box from the side, with all disks where they are now. Colour and arrow are the mean angular velocity over the "
    "last seconds, which the title names: red turns clockwise, blue counter-clockwise, pale hardly at all.",
    "Whether disks keep their colour from one picture to the next. The title has the amplitude A, which falls in "
    "steps.",
    "The first seconds show how much turns at all. The sense of a disk is sure only after a longer mean.",
)
CAPTIONS = (
    Caption(
        "packing.png",
        "Which disk turns which way",
        "Disks in a box, coloured by their mean angular velocity: red clockwise, blue counter-clockwise, with arrows",
        "The first packing from the side, at the amplitude whose Γ is nearest to 2. Colour and arrow are the mean "
        "angular velocity over the whole recording: red turns clockwise, blue counter-clockwise, pale hardly at all. "
        "The scale ends where a tenth of the disks is faster.",
        "Disks that touch. Friction lets them roll on each other if one is red and the other blue, as cog wheels do. "
        "Of three that touch each other not all can do so: at one of the contacts they slide.",
        "The sense of a disk comes from where it lies and whom it touches, since the shaking has none. Another packing "
        "(another seed) has another pattern.",
    ),
    Caption(
        "angular_paths.png",
        "How steadily they turn",
        "Angle against time of every disk, one panel for each strength of shaking; the lines fan out from zero",
        "One panel for each strength of shaking Γ, one line for each disk of the first packing: how far it has turned "
        "since the recording began. Blue counter-clockwise, red clockwise.",
        "How straight the lines are. Mind the scales: each panel has its own, and the strongly shaken disks turn many "
        "times as far.",
        "A straight line is a disk that turns steadily in one sense, not to and fro by chance. Crooked lines show "
        "chance. The quantities ρ² and σₐ below put a number to that.",
    ),
    Caption(
        "rotation_against_gamma.png",
        "More shaking, more rotation",
        "Left: mean squared angular velocity against Gamma on logarithmic axes. Right: steadiness against Gamma",
        "Left: the mean squared angular velocity ⟨ω²⟩ against Γ, both axes logarithmic. Circles are the truth, "
        "squares what accelerometers and camera measure; one mark for each packing, lines through their means. "
        "Dashed: power laws, ours in red, those of the thesis in grey. Right: steadiness ρ² and unsteadiness σₐ.",
        "Left, the bend near Γ = 1: steep below, flat above. At strong shaking the squares fall below the circles. "
        "Right, where ρ² is highest and σₐ lowest.",
        "Below Γ = 1 the disks hardly leave the base, and rotation grows fast with shaking; above, more slowly. The "
        "camera is too slow for the fastest disks, so that it reports too little rotation: part of the flattening is "
        "the camera's.",
    ),
    Caption(
        "accelerometer_spectrum.png",
        "What the accelerometers say",
        "Spectral density of the accelerometer readings at the strongest and the weakest shaking, a line at the drive",
        "The readings of both accelerometers, taken apart into frequencies, at the strongest and at the weakest "
        "shaking. The tall line is the drive. Yellow: the window that is counted as the drive; grey: the side bands "
        "that tell the noise.",
        "How far the line stands above the noise, and the line at 40 Hz. The strength of the drive, a, is in the "
        "legend.",
        "The line is so far above the noise that even the weakest shaking is measured well. At 40 Hz is the second "
        "harmonic of the drive, folded back because the sensors read only 200 times a second.",
    ),
)
