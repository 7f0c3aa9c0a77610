"""`python -m studies`. Ctrl-C ends it without a traceback, as early as it may come."""

if __name__ == "__main__":
    try:
        from jostle_lab.cli import application, call, lazily

        call(application("Figures of both papers, computed anew.", lazily("studies.figures:figure")))
    except KeyboardInterrupt:
        raise SystemExit(130) from None
