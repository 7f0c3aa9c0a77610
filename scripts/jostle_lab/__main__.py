"""`python -m jostle_lab`. Ctrl-C ends it without a traceback, as early as it may come."""

if __name__ == "__main__":
    try:
        from jostle_lab.cli import main

        main()
    except KeyboardInterrupt:
        raise SystemExit(130) from None
