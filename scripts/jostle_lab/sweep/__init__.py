"""Sweeps over parameters: many runs of the native command line on Dask, kept in Parquet, safe to kill and to resume.

    grid (TOML, options) -> runs -> workers -> rows -> Parquet parts -> table

A run is its arguments; it is found again by them and by the bytes of the program. Not here: what a sweep is for
(`jostle_lab.ratchet`).
"""
