"""`python -m studies`. Ctrl-C ends it without a traceback, as early as it may come."""

if __name__ == "__main__":
    try:
        from jostle_lab.cli import application, call, lazily

        commands = ("studies.figures:figure", "studies.thesis.laboratory.command:laboratory")
        call(application("Figures of both papers, computed anew.", *map(lazily, commands)))
    except KeyboardInterrupt:
        raise SystemExit(130) from None
