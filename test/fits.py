"""Drives of our own robot, as some force that nobody commanded changed them, and plain fits."""

from dataclasses import replace

import numpy as np
from rehearsal import Surroundings, rehearse

from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.free_forms.dependence import Dependence
from diffbot_sim.identification.free_forms.structure import find_dependences
from diffbot_sim.identification.recordings.stretches import Stretch, split
from diffbot_sim.identification.selection.evidence import Evidence
from diffbot_sim.identification.selection.screening import Screen
from diffbot_sim.physics import Model
from diffbot_sim.records import Array, Commands, Run

SMOOTH, ROUGH = Surroundings(), Surroundings(roughness=0.3)
# Evidence beyond doubt, of whatever it is said.
SURE = Evidence(90.0, 0.0, 0.0, 0.1, 0.0, 0.0)


def fitted(run: Run, declared: Model | None = None) -> tuple[Fit, tuple[Stretch, ...]]:
    """Return a fit of a model, the plain one or another, to a run, and the held-out rest."""
    learned, held_out = split([run])
    space = Space(declared or Model(), ())
    return fit_prediction(space, learned, space.prior(), FIRST_GAINS), held_out


def without_pose(run: Run) -> Run:
    """Return a run whose odometry tells twists alone."""
    return replace(run, odometry=replace(run.odometry, pose=None))


def leaving(errors: Array) -> Fit:
    """Return a fit of the plain model that leaves these errors over a scale of 1, shape (n, 2)."""
    space = Space(Model(), ())
    fit = Fit(space, (), space.prior(), FIRST_GAINS, np.ones(2))
    fit.__dict__['whitened'] = errors  # where cached_property keeps what it was asked for
    return fit


def left_by(run: Run, declared: Model | None = None) -> list[Dependence]:
    """Return what a fit of a model, the plain one or another, leaves of a run."""
    fit, held_out = fitted(run, declared)
    return find_dependences(Screen(fit), held_out)


def acted_otherwise(
    commands: Commands, force: Array, around: Surroundings = SMOOTH, seed: int = 3
) -> Run:
    """Return what is recorded where the wheels get another force than was commanded."""
    run = rehearse(Model(), replace(commands, force=force), around, seed)
    return replace(run, commands=commands)
