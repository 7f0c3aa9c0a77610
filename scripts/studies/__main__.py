"""`python -m studies`. Ctrl-C ends it without a traceback, as early as it may come."""

if __name__ == "__main__":
    try:
        from jostle_lab.cli import application, call
        from studies.figures import figure
        from studies.ratchet.page import ratchet_page

        call(application("Figures of both papers, computed anew.", figure, ratchet_page))
    except KeyboardInterrupt:
        raise SystemExit(130) from None
