"""Figures of the thesis, computed anew: one command each, `python -m studies figure 3.11`.

A figure is a function: laboratory and effort in; rows of data, a picture and the checked statements out. The laboratory
runs the native command line and keeps what it has run, so that an interrupted figure goes on where it stopped.
"""
