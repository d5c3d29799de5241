"""How often 95 % intervals hold the truth where only numbers are fitted.

python benchmarks/known_structure.py --seeds 0:12            a dozen robots on either floor
"""

from argparse import ArgumentParser
from collections import Counter

from peer_robots import MAKES, exact
from recovery import seed_range
from recovery_cases import FLOORS, Case
from recovery_judge import planted_in, recorded

from diffbot_sim.identification.conclusions.uncertainty import estimates
from diffbot_sim.identification.fitting.calibration import calibrate
from diffbot_sim.identification.fitting.coordinates import Space
from diffbot_sim.identification.fitting.fit import FIRST_GAINS, Fit, fit_prediction
from diffbot_sim.identification.recordings.start import restarted
from diffbot_sim.identification.recordings.stretches import split
from diffbot_sim.physics import Model
from diffbot_sim.physics.effects import sought_effects
from diffbot_sim.records import Run

# Free beside the robot and its friction, and truly zero.
FREE = ('quadratic_drag', 'slope', 'com_offset', 'force_bias', 'yaw_friction')


def main() -> None:
    """Print how many intervals hold the truth; those at a bound do not count."""
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seeds', type=seed_range, default=range(6), help='FIRST:END or a number')
    seeds = parser.parse_args().seeds
    for floor in FLOORS:
        held: Counter[str] = Counter()
        counted: Counter[str] = Counter()
        for seed in seeds:
            for name, holds in judged(floor, seed).items():
                held[name] += holds
                counted[name] += 1
        print(f'{floor}: {held.total()} of {counted.total()}')
        for name in counted:
            print(f'  {name}: {held[name]} of {counted[name]}')


def judged(floor: str, seed: int) -> dict[str, bool]:
    """Return by name of the parameter whether its interval holds the truth."""
    make = tuple(MAKES)[seed % len(MAKES)]
    case = Case('clean', (), '-', make, floor, seed)
    plant, _ = planted_in(case)
    fit = fitted(recorded(case, plant), exact(plant))
    truth = fit.space.values(fit.space.prior())
    found = estimates(fit).items()
    return {n: e.low <= truth[n] <= e.high for n, e in found if not e.at_bound}


def fitted(run: Run, known: Model) -> Fit:
    """Fit the numbers of a robot that is declared as it is."""
    stretches = split([run])[0]
    stretches = restarted(calibrate(Space(known, ()), stretches).model, stretches)
    space = Space(known, tuple(kind for name, kind in sought_effects().items() if name in FREE))
    return fit_prediction(space, stretches, space.prior(), FIRST_GAINS)


if __name__ == '__main__':
    main()
