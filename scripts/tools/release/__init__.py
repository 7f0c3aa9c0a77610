"""What `scripts/release` built: sizes, needs, foreign symbols, and runs in an importer."""
