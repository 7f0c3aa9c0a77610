"""Amplifier voltage in, motion of the base out: the driver, the masses that it carries, and the equations of motion."""
