"""What can be refused: every exception says what was wrong, its value, what is allowed, and what to do."""

from typing import Any


class JostleError(Exception):
    """Anything that jostle refuses.

    Attributes:
        remedy: what to do.
        partial: an `xarray.Dataset` with what `Simulation.run` had sampled before, else None.

    """

    partial: Any = None

    def __init__(self, text: str, remedy: str = "") -> None:
        super().__init__(text)
        self.remedy = remedy

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle with all attributes, so that an exception reaches the process that waits for it."""
        return _rebuild, (type(self), str(self), self.__dict__)


class ParameterError(JostleError, ValueError):
    """A value that is not allowed.

    Attributes:
        name: of the variable or argument.
        value: that was given, as a text.
        allowed: what is allowed, with numbers.

    """

    def __init__(self, text: str, name: str = "", value: str = "", allowed: str = "", remedy: str = "") -> None:
        super().__init__(text, remedy)
        self.name, self.value, self.allowed = name, value, allowed

    @classmethod
    def of(cls, name: str, value: object, allowed: str, remedy: str) -> "ParameterError":
        """Say it as the engines do."""
        return cls(f"{name} = {value} is not allowed: {allowed}. {remedy}", name, str(value), allowed, remedy)


class StepError(JostleError, RuntimeError):
    """A step that cannot be done; the simulation is as it was before the step.

    Attributes:
        time: simulated time at which the trouble showed [s].

    """

    def __init__(self, text: str, time: float = float("nan"), remedy: str = "") -> None:
        super().__init__(text, remedy)
        self.time = time


class StateError(JostleError, ValueError):
    """A saved state that is damaged, or of another scene or version."""


class CallError(JostleError, RuntimeError):
    """A call that cannot be done now, such as setting a parameter after the start."""


class NoVariableError(JostleError, KeyError):
    """The scene has no such variable."""

    def __str__(self) -> str:
        """Return the text; `KeyError` would put it in quotation marks."""
        return str(self.args[0])


class DefectError(JostleError, RuntimeError):
    """A defect of jostle; only the simulation that showed it is affected."""


class JostleWarning(UserWarning):
    """Doubtful parameters."""


def _rebuild(kind: type[JostleError], text: str, attributes: dict[str, Any]) -> JostleError:
    error = kind(text)
    error.__dict__.update(attributes)
    return error
