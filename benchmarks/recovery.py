"""How often identification is right: clean robots, and robots with one effect, on two floors.

python benchmarks/recovery.py --seeds 20            clean sets and every effect, smooth and rough
python benchmarks/recovery.py --seeds 20 --only clean
"""

import json
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter

import numpy as np

from diffbot_sim.control.rehearsal import Surroundings, random_forces, rehearse
from diffbot_sim.identification import identify
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import library

DURATION, LEAST, MOST = 120.0, -9.0, 11.0
FLOORS = {'smooth': Surroundings(), 'rough': Surroundings(roughness=0.3)}
DECLARED = Model(
    Robot(mass=11.0, inertia=0.35),
    Friction(mu_coulomb=0.035, mu_static=0.045, mu_viscous=0.07),
)
# Sizes of the planted effects, in their own scales.
SIZES = (2.0, 4.0)


def planted(name: str, seed: int) -> Model:
    """Return the true robot of a case: clean, or with one effect of random size and sign."""
    if name == 'clean':
        return Model()
    random, kind = np.random.default_rng([seed, len(name)]), library()[name]
    signs = [random.choice([-1.0, 1.0]) if s.low < s.default else 1.0 for s in kind.specs()]
    values = {
        spec.name: spec.default + sign * spec.scale * random.uniform(*SIZES)
        for spec, sign in zip(kind.specs(), signs, strict=True)
    }
    return Model().with_effect(kind(**values))


def cases(only: str | None, seeds: int) -> Iterator[tuple[str, str, int]]:
    """List name, floor and seed of every case."""
    for name in ['clean', *library()] if only is None else [only]:
        for floor in FLOORS:
            for seed in range(seeds):
                yield name, floor, seed


def main() -> None:
    """Run all cases, print a line each and the table of shares."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument('--seeds', type=int, default=20)
    parser.add_argument('--only', choices=['clean', *library()])
    parser.add_argument('--out', type=Path, default=Path('out/recovery.json'))
    options = parser.parse_args()
    rows = []
    for name, floor, seed in cases(options.only, options.seeds):
        begin = perf_counter()
        commands = random_forces(seed, DURATION, LEAST, MOST)
        run = rehearse(planted(name, seed), commands, FLOORS[floor], seed)
        result = identify([run], DECLARED)
        found = [effect.name for effect in result.effects]
        right = found == ([] if name == 'clean' else [name]) and result.unexplained is None
        rows.append({'case': name, 'floor': floor, 'seed': seed, 'right': right, 'found': found})
        told = result.verdict if not found else ', '.join(found)
        print(f'{name} {floor} {seed}: {told} ({perf_counter() - begin:.0f} s)', flush=True)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(rows, indent=1))
    for name in dict.fromkeys(row['case'] for row in rows):
        for floor in FLOORS:
            group = [row for row in rows if (row['case'], row['floor']) == (name, floor)]
            print(f'{name:32} {floor:8} right {sum(r["right"] for r in group)} of {len(group)}')


if __name__ == '__main__':
    main()
