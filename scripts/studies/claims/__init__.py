"""Every claim of both papers on one page."""
