"""The FMU of one disk on two supports whose input is a torque (scene `three_disk`), stepped and stopped at events."""

from jostle_lab.fmu.instance import FmuInstance


class DiskFmu(FmuInstance):
    """One disk on two supports; with `events`, `step_to` ends where a contact begins to stick, to slip or to open."""

    scene = "three_disk"

    def _prepare(self) -> None:
        self._torque = self.group(["torque"])
        self._velocity, self._angle = self.group(["disk.angular_velocity[1]"]), self.group(["disk.angle[1]"])
        self.contact_states()

    def velocity(self) -> float:
        """Angular velocity [rad/s]."""
        return float(self.read_group(self._velocity)[0])

    def angle(self) -> float:
        """Angle [rad]."""
        return float(self.read_group(self._angle)[0])

    def contact_states(self) -> tuple[int, int]:
        """State of both contacts: 1 open, 2 stick, 3 slip counter-clockwise, 4 slip clockwise."""
        left, right = self.read_integers(["contact[1].state", "contact[2].state"])
        return left, right

    def apply(self, torque: float) -> None:
        """Hold this torque [N m] from now on."""
        self._torque.values[0] = torque
        self.write_group(self._torque, "setting the torque")
