"""Differential-drive dynamics with set-valued wheel friction. Reads no file and no clock."""

from diffbot_sim.physics.friction import Friction
from diffbot_sim.physics.model import Model
from diffbot_sim.physics.plant import Plant
from diffbot_sim.physics.robot import Robot
from diffbot_sim.physics.simulation import simulate

__all__ = ['Friction', 'Model', 'Plant', 'Robot', 'simulate']
