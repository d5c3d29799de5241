"""All experiments and all errors, in the paper's order, and how to find them by name."""

from collections.abc import Sequence

from diffbot_sim.errors import DiffbotError
from diffbot_sim.paper.errata import (
    arc_radius,
    forces_of_coefficients,
    rest_branch,
    stick_test,
    viscous_sign,
)
from diffbot_sim.paper.experiment import Experiment
from diffbot_sim.paper.experiments import (
    block,
    curves,
    frictionless,
    inner_loop,
    push,
    with_friction,
)
from diffbot_sim.parameters import suggestion

EXPERIMENTS: tuple[Experiment, ...] = (
    frictionless.EXPERIMENT,
    curves.EXPERIMENT,
    block.COULOMB,
    block.GENERALIZED,
    push.EXPERIMENT,
    with_friction.EXPERIMENT,
    inner_loop.EXPERIMENT,
)
ERRATA: tuple[Experiment, ...] = (
    arc_radius.EXPERIMENT,
    viscous_sign.EXPERIMENT,
    rest_branch.EXPERIMENT,
    forces_of_coefficients.EXPERIMENT,
    stick_test.EXPERIMENT,
)


def chosen(names: Sequence[str]) -> tuple[Experiment, ...]:
    """Return the experiments and errata of these names, or all; raises DiffbotError."""
    every = {experiment.name: experiment for experiment in (*EXPERIMENTS, *ERRATA)}
    for name in names:
        if name not in every:
            raise DiffbotError(f'{name}: unknown experiment. {suggestion(name, list(every))}')
    return tuple(every[name] for name in names or every)
