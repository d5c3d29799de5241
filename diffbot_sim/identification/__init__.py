"""Finds what a model lacks from recorded runs. Never opens a bag."""

from diffbot_sim.identification.identify import identify
from diffbot_sim.identification.result import Identification

__all__ = ['Identification', 'identify']
