"""Figures of both papers, computed anew; part of the source tree, not of the installed package.

python -m studies figure 3.11 F6
"""
