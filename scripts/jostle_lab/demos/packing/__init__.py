"""Packings shaken with decreasing amplitude: pictures and a page of numbers."""
