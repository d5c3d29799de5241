"""One case judged: drive the peer plant, identify, and compare the answer with the truth."""

from dataclasses import asdict, replace
from time import perf_counter

import numpy as np
from peer_drives import DRIVES, closed_loop
from peer_effects import with_effect
from peer_manoeuvres import MANOEUVRES
from peer_plant import Plant
from peer_recording import Recording, record, repeat
from peer_robots import MAKES, declared
from peer_sensors import SENSORS, sensed
from peer_sizes import size_of
from recovery_cases import Case, Row

from diffbot_sim.identification import identify
from diffbot_sim.identification.result import ErrorNorm, Identification
from diffbot_sim.physics.effects import sought_effects
from diffbot_sim.records import Run

# What sensors make of a drive is made of odometry at this rate [Hz]; so often a controller hears.
OFTEN = 100.0
# The memory of a floor whose pushes change between the samples [s].
SHORT = 0.05


def judge(case: Case) -> Row:
    """Return a case's row: what was planted, what was answered, and on which evidence."""
    begin = perf_counter()
    plant, planted = planted_in(case)
    run = recorded(case, plant)
    removed = case.effects if case.removed else ()
    kinds = [kind for name, kind in sought_effects().items() if name not in removed]
    row = {'name': case.name, **asdict(case), 'planted': planted}
    try:
        found = identify([run], declared(MAKES[case.make], case.seed), kinds=kinds)
    except Exception as problem:  # one case must not end the others
        return {**row, 'verdict': 'failed', 'found': [], 'problem': repr(problem)}
    row |= _answer(found) | {'ideal': _ideal(case, plant, run, found)}
    return {**row, 'seconds': round(perf_counter() - begin, 1)}


def planted_in(case: Case) -> tuple[Plant, dict[str, float]]:
    """Return a case's robot, and its numbers that are not those of the robot without effects."""
    make = MAKES[case.make]
    plant = make.plant._replace(creep=case.creep)
    for name in case.effects:
        size = size_of(make, name, case.size, case.seed)
        plant = with_effect(plant, make, name, size, case.seed)
    old = make.plant._asdict()
    return plant, {key: value for key, value in plant._asdict().items() if value != old[key]}


def recorded(case: Case, plant: Plant) -> Run:
    """Drive a case's robot. Random drives, command rate and pose take turns with the seed."""
    make, seed = MAKES[case.make], case.seed
    drive = MANOEUVRES[case.drive] if case.drive else tuple(DRIVES.values())[seed % 2]
    how = Recording(
        rate=(50.0, 100.0)[seed // 2 % 2],
        roughness=make.roughness * (case.floor == 'rough'),
        dead_reckoned=seed % 4 == 3,
    )
    if case.heard:
        drive = closed_loop
        how = replace(how, rate=OFTEN, memory=SHORT, hears_all=True)
    if case.sensors:
        how = replace(how, odometry=OFTEN, v_noise=0.0, omega_noise=0.0)
    run = record(plant, drive(make, seed, how.duration, how.rate), how, seed, case.name)
    return sensed(run, plant, SENSORS[case.sensors], seed) if case.sensors else run


def _answer(found: Identification) -> Row:
    """Tell an identification in plain values."""
    return {
        'verdict': found.verdict,
        'found': [effect.name for effect in found.effects],
        'alternatives': {e.name: list(e.alternatives) for e in found.effects},
        'parameters': {
            effect.name: {k: [p.value, p.low, p.high] for k, p in effect.parameters.items()}
            for effect in found.effects
        },
        'evidence': {effect.name: effect.evidence for effect in found.effects},
        'unexplained': None if found.unexplained is None else found.unexplained.description,
        'candidates': [asdict(candidate) for candidate in found.candidates],
        'errors': asdict(found.errors),
    }


def _ideal(case: Case, plant: Plant, run: Run, found: Identification) -> Row:
    """Return the held-out error of the true plant, which does not know how the floor pushes."""
    again = repeat(plant, run, OFTEN if case.sensors else Recording.odometry)
    if case.sensors:
        again = sensed(again, plant, SENSORS[case.sensors].quiet, case.seed)
    # Stamps may have been found late and moved: what lies within counts.
    time, parts = run.odometry.time, [c.time for c in found.comparisons]
    rows = np.any([(part[0] <= time) & (time <= part[-1]) for part in parts], axis=0)
    missed = (again.odometry.twist - run.odometry.twist)[rows]
    v, omega = np.sqrt(np.mean(missed**2, axis=0))
    return asdict(ErrorNorm(float(v), float(omega)))
