"""`python -m jostle`: the command line."""

from jostle.installed import main

main()
