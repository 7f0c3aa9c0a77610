"""`python -m tools`. Ctrl-C ends it without a traceback, as early as it may come."""

if __name__ == "__main__":
    try:
        from jostle_lab.cli import application, call
        from tools.import_circles import import_circles
        from tools.instruction_counts import instruction_counts
        from tools.notices import notices
        from tools.peers import peers
        from tools.readme_picture import readme_picture
        from tools.release.command import binaries, verify
        from tools.stability_page import stability
        from tools.work_precision.work_precision_cli import work_precision

        commands = (work_precision, stability, instruction_counts, import_circles, peers, binaries, verify, notices)
        call(application("Tools of the project itself.", *commands, readme_picture))
    except KeyboardInterrupt:
        raise SystemExit(130) from None
