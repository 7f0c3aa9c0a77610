"""`python -m tools`. Ctrl-C ends it without a traceback, as early as it may come."""

COMMANDS = (
    "tools.work_precision.work_precision_cli:work_precision",
    "tools.stability_page:stability",
    "tools.real_time_page:real_time",
    "tools.base_on_inputs:base_on_inputs",
    "tools.instruction_counts:instruction_counts",
    "tools.import_circles:import_circles",
    "tools.importers.command:importers",
    "tools.peers:peers",
    "tools.release.command:binaries",
    "tools.release.command:bundle_release",
    "tools.release.command:verify",
    "tools.notices:notices",
    "tools.film_frames:film_frames",
    "tools.readme_film:readme_film",
    "tools.readme_picture:readme_picture",
    "tools.live_page:live_page",
    "tools.notebooks:notebooks",
    "tools.two_builds:two_builds",
    "tools.misuse:misuse",
)

if __name__ == "__main__":
    try:
        from jostle_lab.cli import application, call, lazily

        call(application("Tools of the project itself.", *map(lazily, COMMANDS)))
    except KeyboardInterrupt:
        raise SystemExit(130) from None
