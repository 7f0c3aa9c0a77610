"""Importers too heavy for the tests, each in an environment of its own: what they make of our FMUs."""
