"""`python -m jostle_lab`."""

from jostle_lab.cli import main

if __name__ == "__main__":
    main()
