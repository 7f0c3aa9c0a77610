"""`python -m studies`."""

from jostle_lab.cli import application, call
from studies.figures import figure
from studies.ratchet.page import ratchet_page

if __name__ == "__main__":
    call(application("Figures of both papers, computed anew.", figure, ratchet_page))
