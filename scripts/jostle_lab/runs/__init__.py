"""Runs of the native command line: single ones, kept on disk, and sweeps over parameters into Parquet.

    grid (TOML, options) -> runs -> workers -> rows -> Parquet parts -> table

A run is its arguments; it is found again by them and by the bytes of the program.
"""
