"""How large an effect must be to be weak, typical or strong: weak ones just show.

python benchmarks/peer_sizes.py        what each effect adds to the error of a nominal model
"""

from argparse import ArgumentParser
from math import sqrt

import numpy as np
from peer_drives import Driver, random_forces
from peer_effects import EFFECTS, FOREIGN, with_effect
from peer_plant import Plant
from peer_recording import Recording, record
from peer_robots import MAKES, Make

from diffbot_sim.records import Array

# A weak effect raises the recalibrated nominal model's free-running error to so much of the noise.
WEAK_ERROR = 1.3
STRONG = 2.5  # in typical effects
TRIALS = 5
RECALIBRATED = ('mass', 'inertia', 'static', 'coulomb', 'viscous', 'stribeck')
NUDGE = 0.02  # of each of these, for their sensitivities


def size_of(make: Make, name: str, how: str, seed: int) -> float:
    """Return the size of an effect that is 'weak', 'typical', 'strong' or '2×' a weak one."""
    if how in ('typical', 'strong'):
        return {'typical': 1.0, 'strong': STRONG}[how]
    times = 1.0 if how == 'weak' else float(how.rstrip('×'))
    return times * weak(make, name, seed)


def weak(make: Make, name: str, seed: int) -> float:
    """Return the size at which an effect is weak; its misfit grows about as its size."""
    drive = _Quiet(make, seed)
    size, wanted = 0.5, sqrt(WEAK_ERROR**2 - 1.0)
    for _ in range(TRIALS):
        misfit = drive.misfit(with_effect(make.plant, make, name, size, seed))
        size = float(np.clip(size * np.clip(wanted / max(misfit, 1e-6), 0.2, 3.0), 1e-3, 3.0))
    return size


class _Quiet:
    """A drive without noise, and what a recalibrated nominal model can explain of it."""

    def __init__(self, make: Make, seed: int) -> None:
        self._driver: Driver = random_forces(make, seed, 120.0, 50.0)
        self._nominal = self._twist(make.plant)
        rows = [self._twist(_nudged(make.plant, name)) - self._nominal for name in RECALIBRATED]
        self._explained = np.linalg.qr(np.column_stack(rows))[0]

    def misfit(self, plant: Plant) -> float:
        """Return the rms error of the nominal model that fits best, in units of the noise."""
        missed = self._twist(plant) - self._nominal
        missed -= self._explained @ (self._explained.T @ missed)
        return float(np.sqrt(np.mean(missed**2)))

    def _twist(self, plant: Plant) -> Array:
        how = Recording(v_noise=0.0, omega_noise=0.0)
        twist = record(plant, self._driver, how, 0).odometry.twist
        return (twist / [Recording.v_noise, Recording.omega_noise]).ravel()


def _nudged(plant: Plant, name: str) -> Plant:
    return plant._replace(**{name: (1.0 + NUDGE) * getattr(plant, name)})


def main() -> None:
    """Print weak sizes, and the error that typical effects leave to a nominal model."""
    ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    for make in MAKES:
        drive = _Quiet(MAKES[make], 0)
        for name in EFFECTS | FOREIGN:
            plant = with_effect(MAKES[make].plant, MAKES[make], name, 1.0, 0)
            typical = sqrt(1.0 + drive.misfit(plant) ** 2)
            told = f'weak {weak(MAKES[make], name, 0):.3f}, typical error {typical:.2f} × noise'
            print(f'{make:7} {name:30} {told}', flush=True)


if __name__ == '__main__':
    main()
