"""`jostle-lab loudspeaker`. What takes long to import is imported when it is needed."""

import typer


def loudspeaker() -> None:
    """Print the loudspeaker: driver, masses, and what full drive asks of it."""
    from jostle_lab.loudspeaker.driver import CARRIED_MASSES, GBS_250F38CP01_04
    from jostle_lab.loudspeaker.model import Loudspeaker

    speaker, driver = Loudspeaker(1.0 / 2400), GBS_250F38CP01_04
    typer.echo(f"{driver.name}\n  {driver.source}")
    for name, mass in CARRIED_MASSES.items():
        typer.echo(f"  {mass:6.3f} kg  {name}")
    typer.echo(f"  {speaker.mass:6.3f} kg  in all, with {driver.moving_mass} kg of cone and coil")
    typer.echo(f"  {1e3 * speaker.static_sag():.2f} mm sag of {1e3 * driver.maximum_excursion:g} mm linear excursion")
    for gamma in (0.2, 1.0, 5.0, 8.0):
        voltage = speaker.voltage_for_acceleration(gamma * 9.8)
        response = speaker.steady_state(voltage)
        power = 0.5 * abs(response.current) ** 2 * driver.coil_resistance
        typer.echo(
            f"  Gamma {gamma:3.1f}: {voltage:6.2f} V, {abs(response.current):5.2f} A peak, {power:6.1f} W of "
            f"{driver.rated_power:g} W, {1e3 * abs(response.displacement):.3f} mm"
        )
