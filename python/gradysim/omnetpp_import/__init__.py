"""Translates files of OMNeT++ with INET, or with GrADyS' C++ project, to scenarios of gradysim."""

from gradysim.omnetpp_import.outcome import Action, Outcome
from gradysim.omnetpp_import.translate import Translation, translate

__all__ = ["Action", "Outcome", "Translation", "translate"]
