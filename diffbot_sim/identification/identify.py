"""From runs and a declared model to what the model lacks."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from typing import NamedTuple, TypeVar

from diffbot_sim.identification.conclusions.advice import advice
from diffbot_sim.identification.conclusions.agreement import agreement
from diffbot_sim.identification.conclusions.comparison import compare_models, errors_of
from diffbot_sim.identification.conclusions.empirical import term_in, with_term
from diffbot_sim.identification.conclusions.horizons import horizons
from diffbot_sim.identification.conclusions.uncertainty import estimates
from diffbot_sim.identification.finding import Question
from diffbot_sim.identification.fitting.fit import Fit
from diffbot_sim.identification.following import follows_nothing
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.questioning import searched
from diffbot_sim.identification.recordings.gyro import bias_of, unbiased
from diffbot_sim.identification.recordings.lateness import filled
from diffbot_sim.identification.recordings.noiseless import odometry_noise
from diffbot_sim.identification.recordings.recordings import Recordings
from diffbot_sim.identification.result import (
    EFFECTS_FOUND,
    NOTHING_MISSING,
    UNEXPLAINED,
    Candidate,
    ErrorNorm,
    Estimate,
    FoundEffect,
    Identification,
    Structure,
    Table,
)
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import Progress, Trial
from diffbot_sim.identification.simulating import for_simulation
from diffbot_sim.physics.effects import Effect, sought_effects
from diffbot_sim.physics.model import Model
from diffbot_sim.records import Run

Value = TypeVar('Value')


class _Simulated(NamedTuple):
    """The fit that is simulated, what it leaves without a name, and the table that is of that."""

    fit: Fit
    unexplained: Structure | None
    table: Table | None


def identify(
    runs: Sequence[Run],
    declared: Model,
    validate: Sequence[Run] = (),
    progress: Progress = lambda text: None,
    kinds: Sequence[type[Effect]] | None = None,
) -> Identification:
    """Recalibrate a declared model on runs, and find the effects that it lacks.

    validate: runs for the before/after errors; without them the last part of each run is held
    out. kinds: the effects to try, by default the whole library. Raises DataError where the
    runs are too short or do not move, or the declared mass or inertia is in another unit.
    """
    given = Recordings(tuple(runs), tuple(validate)).each(filled)
    recordings = given.each(unbiased)
    known = tuple(sought_effects().values()) if kinds is None else tuple(kinds)
    found, denied = searched(recordings, Question(declared, known, progress))
    if len(given.all) > 1:
        progress('holding the runs against each other')
    return replace(
        _concluded(found, declared),
        contradicted=denied,
        timings=found.timings(recordings),
        biases=tuple(filter(None, map(bias_of, given.all, recordings.all))),
    )


def _concluded(found: Found, declared: Model) -> Identification:
    """Return the answer that follows from what was found."""
    selection, held_out = found.selection, found.held_out
    final, unexplained, table = _simulated(found)
    # Beside friction near rest effects were held where the prediction has them.
    known = estimates(selection.final if found.near_rest else final)
    # Whatever gave the parameters, the noise model that the disturbances call for watches them.
    watched = replace(final, gains=selection.final.gains)
    models = (declared, found.recalibrated.model, final.model)
    comparisons = compare_models(declared, found.recalibrated.model, watched, held_out)
    errors = errors_of(comparisons, 'validate' if found.recordings.validate else 'held_out')
    noise = ErrorNorm.of(odometry_noise(declared.half_separation))
    nominal = estimates(found.recalibrated)
    return Identification(
        verdict=_verdict(selection, unexplained),
        effects=tuple(_effects(selection, known)),
        unexplained=unexplained,
        nominal=nominal,
        nominal_beside={name: known[name] for name in nominal} if found.names else {},
        errors=errors,
        candidates=tuple(_candidate(trial) for trial in selection.trials),
        declared=declared,
        recalibrated=found.recalibrated.model,
        identified=final.model,
        comparisons=comparisons,
        # Where no effect was tried the recording is at fault, and no other drive would help.
        advice=advice(selection, known) if selection.trials else (),
        empirical=table,
        horizons=horizons(models, watched, held_out, errors),
        runs=agreement(selection.final, found.recordings.all, found.aside),
        near_rest=found.near_rest,
        added_noise=noise if found.noisy else None,
    )


def _simulated(found: Found) -> _Simulated:
    """Choose the fit that is simulated, with a table of what has no name where that is better."""
    fit, held_out = for_simulation(found), found.held_out
    left = found.unexplained or follows_nothing(fit, held_out)
    closed = None if left is None else with_term(fit, left, held_out)
    if left is None or closed is None:
        return _Simulated(fit, left, None)
    return _Simulated(closed, left, term_in(closed.model, left))


def _verdict(selection: Selection, unexplained: Structure | None) -> str:
    if selection.final.space.kinds:
        return EFFECTS_FOUND
    return NOTHING_MISSING if unexplained is None else UNEXPLAINED


def _effects(selection: Selection, found: Mapping[str, Estimate]) -> Iterator[FoundEffect]:
    """Describe the effects found, the one with most evidence first."""
    drives = selection.excitation
    for name in sorted(selection.support, key=lambda name: -selection.support[name].delta_bic):
        others = selection.alternatives[name]
        alike = (name, *others) if others else ()
        yield FoundEffect(
            name=name,
            parameters=_own(found, name),
            evidence=asdict(selection.support[name]),
            alternatives=others,
            separate_by='; '.join(sorted({drives[each] for each in alike})),
        )


def _own(values: Mapping[str, Value], effect: str) -> dict[str, Value]:
    """Return what belongs to an effect, by the names of its parameters."""
    begin = f'{effect}.'
    return {k.removeprefix(begin): v for k, v in values.items() if k.startswith(begin)}


def _candidate(trial: Trial) -> Candidate:
    evidence = trial.evidence
    values = {} if trial.fit is None else trial.fit.space.values(trial.fit.u)
    return Candidate(
        trial.kind.name,
        evidence.delta_bic,
        evidence.p_value,
        evidence.p_block,
        evidence.held_out_gain,
        trial.outcome,
        _own(values, trial.kind.name),
    )
