"""Tools of the project itself; part of the source tree, not of the installed package. `python -m tools` lists them."""
