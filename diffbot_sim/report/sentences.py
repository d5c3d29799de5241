"""The words of the report: what was found, how sure it is, and in which units."""

from collections.abc import Sequence
from math import inf, isfinite, log

from diffbot_sim.identification.result import (
    EFFECTS_FOUND,
    LAW,
    NOTHING_MISSING,
    Errors,
    FoundEffect,
    Identification,
    RunCheck,
    Structure,
)
from diffbot_sim.physics.effects import Effect
from diffbot_sim.report.numerals import (
    DASH,
    estimate_text,
    significant,
    speed_text,
    turn_rate_text,
    unit_text,
)

SPLITS = {
    'validate': 'on whole runs that were not fitted',
    'held_out': 'on the last part of each run, which was not fitted',
}

# Errors within this many noise floors need no words; what more there is has no visible cause.
NEAR = 1.5
PUSHED = '; what lies between follows nothing that was recorded, as pushes of an uneven floor do'

DISAGREES = 'disagrees with the other runs'
SET_ASIDE = (
    'is of another robot or another condition than the other runs, which agree, and was set aside'
)


def verdict(result: Identification) -> str:
    """Say the answer in one sentence."""
    if result.verdict == NOTHING_MISSING:
        return f'Nothing missing{_but(result.contradicted)}: {_sufficient(result)}.'
    found = _listed([_named(effect) for effect in result.effects])
    denied = f'; contradicted: {_declared(result.contradicted)}' if result.contradicted else ''
    if result.verdict == EFFECTS_FOUND:
        besides = f'; left unexplained: {_left(result)}' if result.unexplained else _pushed(result)
        return f'Found: {found}{denied}; {_fall(result.errors)}{besides}.'
    return f'Unexplained: {_left(result)}{denied}; {_fall(result.errors)}.'


def of_declared(result: Identification) -> list[str]:
    """Say which declared effects are not there as declared, and which were recalibrated."""
    denied = [_denied(result, name) for name in result.contradicted]
    now = {effect.name: effect for effect in result.recalibrated.effects}
    pairs = [(effect, now.get(effect.name, effect)) for effect in result.declared.effects]
    return denied + [_recalibrated(was, it) for was, it in pairs if it != was]


def _denied(result: Identification, name: str) -> str:
    """Say what to do about what is contradicted."""
    if name == LAW:
        declared, taken = (it.friction.model for it in (result.declared, result.identified))
        what, then = f'{LAW} {declared}', f'{taken} was taken'
    else:
        there = any(effect.name == name for effect in result.effects)
        what, then = name, 'it is found with other parameters' if there else 'remove it'
    return f'{what} is declared, and the recordings contradict it: {then}.'


def _recalibrated(was: Effect, now: Effect) -> str:
    values = zip(now.specs(), was.values, now.values, strict=True)
    changes = [
        f'{spec.name} {significant(new)} for {significant(old)}{unit_text(spec.unit)}'
        for spec, old, new in values
        if new != old
    ]
    return f'{now.name}, which is declared, was recalibrated: {_listed(changes)}.'


def _but(contradicted: Sequence[str]) -> str:
    return f', but {_declared(contradicted)} is contradicted' if contradicted else ''


def _declared(contradicted: Sequence[str]) -> str:
    return f'the declared {_listed(tuple(contradicted))}'


def _sufficient(result: Identification) -> str:
    left, floor = result.errors.recalibrated, result.errors.noise_floor
    without = ' without that' if result.contradicted else ''
    return (
        f'recalibrated{without}, the declared model predicts held-out speed to '
        f'{speed_text(left.v_rmse)} and turn rate to {turn_rate_text(left.omega_rmse)}; '
        f'noise floor {speed_text(floor.v_rmse)} and {turn_rate_text(floor.omega_rmse)}'
        f'{_pushed(result)}'
    )


def _pushed(result: Identification) -> str:
    """Say of what is left without a visible cause that it has none; empty near the noise."""
    left, floor = result.errors.with_effects, result.errors.noise_floor
    near = left.v_rmse <= NEAR * floor.v_rmse and left.omega_rmse <= NEAR * floor.omega_rmse
    return '' if near else PUSHED


def _named(effect: FoundEffect) -> str:
    values = ', '.join(f'{name} {estimate_text(it)}' for name, it in effect.parameters.items())
    rivals = f'; {_listed(effect.alternatives, "or")} would do as well'
    inside = values + (rivals if effect.alternatives else '')
    return f'{effect.name} ({inside})' if inside else effect.name


def _fall(errors: Errors) -> str:
    """Tell of the axis, speed or turn rate, whose error changes most, or that is most wrong."""
    before, after, floor = errors.recalibrated, errors.with_effects, errors.noise_floor
    if before == after:
        turning = after.omega_rmse * floor.v_rmse > after.v_rmse * floor.omega_rmse
    else:
        turning = _change(before.omega_rmse, after.omega_rmse) > _change(
            before.v_rmse, after.v_rmse
        )
    what, said = ('turn-rate', turn_rate_text) if turning else ('speed', speed_text)
    key = 'omega_rmse' if turning else 'v_rmse'
    old, new, least = (getattr(norm, key) for norm in (before, after, floor))
    if said(old) == said(new):
        return f'held-out {what} error {said(old)}; noise floor {said(least)}'
    change = f'{"falls" if new < old else "rises"} from {said(old)} to {said(new)}'
    return f'held-out {what} error {change}; noise floor {said(least)}'


def _change(before: float, after: float) -> float:
    """Return by which factor an error fell or rose, as a logarithm; endless from or to nothing."""
    if before == after:
        return 0.0
    return abs(log(after / before)) if before > 0.0 < after else inf


def structure(left: Structure) -> str:
    """Say how strong the unexplained structure is and how sure."""
    unit = 'N·m' if left.axis == 'omega' else 'N'
    return (
        f'{significant(left.strength)} {unit} root mean square '
        f'({left.variable.replace("_", " ")}); p {p_text(left.p_value)}, robust against serial '
        'correlation.'
    )


def empirical(result: Identification) -> str:
    """Say whether a table in model.yaml stands for what is unexplained."""
    if result.unexplained is None:
        return ''
    if result.empirical is None:
        return 'No table in model.yaml stands for it: none can, or it did not simulate better.'
    return (
        f'In model.yaml a table, {result.empirical.name}, stands for it: no law, but it lowers '
        'the held-out error.'
    )


def _left(result: Identification) -> str:
    if result.unexplained is None:
        return 'the residual has structure that no effect of the library accounts for'
    return result.unexplained.description.strip().rstrip('.')


def alternatives(effect: FoundEffect) -> str:
    """Say what the data cannot tell apart and which drive would; empty where it can."""
    if not effect.alternatives:
        return ''
    rivals = _listed(effect.alternatives, 'or')
    drive = f' To separate them: {effect.separate_by.rstrip(".")}.' if effect.separate_by else ''
    return f'This data cannot tell {effect.name} from {rivals}.{drive}'


def split(errors: Errors) -> str:
    """Say on which data the errors were measured."""
    return SPLITS.get(errors.split, errors.split)


def disagreements(runs: Sequence[RunCheck]) -> list[str]:
    """Name the runs that disagree with the others; of two, nobody can say which is odd."""
    odd = [run for run in runs if not run.agrees]
    if len(runs) == 2 and odd:
        return [f'{runs[0].name} and {runs[1].name} disagree. {odd[0].name}: {why(odd[0])}.']
    return [f'{run.name} {SET_ASIDE if run.set_aside else DISAGREES}: {why(run)}.' for run in odd]


def why(run: RunCheck) -> str:
    """Say in which parameters a run differs, the surest three; empty where it agrees."""
    if run.own_effects:
        return f'by itself it shows {_listed(run.own_effects, "and")}, which they deny'
    if run.set_aside and not run.differences:
        return 'beside them something would be missing'
    return '; '.join(
        f'{it.name} {estimate_text(it.here)}, elsewhere {estimate_text(it.others)}'
        for it in run.differences[:3]
    )


def p_text(p: float) -> str:
    """Write a p-value; the smallest are told as a bound."""
    if not isfinite(p):
        return DASH
    return '< 1e-12' if p < 1e-12 else f'{p:.2g}'


def _listed(words: list[str] | tuple[str, ...], last: str = 'and') -> str:
    if len(words) < 2:
        return ''.join(words)
    return f'{", ".join(words[:-1])} {last} {words[-1]}'
