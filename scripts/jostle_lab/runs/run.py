"""One `jostle run`, as the arguments of the command line."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Run:
    """Scene, engine, drive, duration and parameters."""

    scene: str
    engine: str
    seconds: float
    sample: float
    """Time from row to row [s]."""
    settings: tuple[tuple[str, float], ...]
    """Parameters by name."""
    disks: int | None = None
    """Number of disks; None: the scene's own."""
    drive: str = field(default="sine", kw_only=True)

    def arguments(self) -> list[str]:
        """Arguments of `jostle`, without the output file."""
        words = ["run", self.scene, "--engine", self.engine, "--drive", self.drive]
        words += ["--disks", str(self.disks)] if self.disks is not None else []
        words += ["--seconds", repr(self.seconds), "--sample", repr(self.sample)]
        for name, value in self.settings:
            words += ["--set", f"{name}={value!r}"]
        return words

    def key(self) -> str:
        """The arguments as one text."""
        return " ".join(self.arguments())

    @property
    def seed(self) -> int | None:
        """Seed of the run, if one is set."""
        return next((int(value) for name, value in self.settings if name == "seed"), None)
