"""Advice: what the recorded drive does not show, and which drive would."""

from collections.abc import Mapping
from math import isfinite

from diffbot_sim.identification.fitting.coordinates import FITTED_OF_ROBOT, WIDEST_FACTOR
from diffbot_sim.identification.result import Estimate
from diffbot_sim.identification.selection.stepwise import Selection
from diffbot_sim.identification.selection.trials import UNSEEN

# An interval wider than this share of its value, either way, tells little of a parameter.
WIDE = 0.2
# What is fitted as a factor of its declared value, and stopped at the widest one.
BY_FACTOR = (*FITTED_OF_ROBOT, 'stribeck')
DRIVES = {
    'mass': 'hard acceleration and braking, straight ahead',
    'inertia': 'turns that begin and end fast',
    'mu_static': 'many starts from rest by slowly rising forces',
    'mu_coulomb': 'slow, steady rolling and coasting to a stop',
    'mu_viscous': 'steady rolling at several speeds, some of them high',
    'stribeck': 'creeping: the slowest steady rolling that the drive can hold',
}


def advice(selection: Selection, found: Mapping[str, Estimate]) -> tuple[str, ...]:
    """Say what is not identifiable and what to drive next, effects first."""
    unseen = [trial.kind for trial in selection.trials if trial.outcome == UNSEEN]
    vague = {name: it for name, it in found.items() if _is_vague(it)}
    drives = selection.excitation
    return (
        *(
            f'{kind.name} cannot be seen in this drive; it would take {kind.excitation}.'
            for kind in unseen
        ),
        *(
            f'{name} is {_how(name, it)}; it would take '
            f'{DRIVES.get(name) or drives[name.partition(".")[0]]}.'
            for name, it in vague.items()
        ),
    )


def _is_vague(it: Estimate) -> bool:
    return it.at_bound or 0.5 * (it.high - it.low) > WIDE * abs(it.value)


def _how(name: str, it: Estimate) -> str:
    if it.at_bound and name in BY_FACTOR:
        far = f'{WIDEST_FACTOR:g} times larger or smaller than declared'
        return f'{far}, the limit of any fit: declare it nearer, or this drive leaves it open'
    if it.at_bound:
        return 'at the end of its valid range, so this drive leaves it open'
    share = 0.5 * (it.high - it.low) / abs(it.value) if it.value else float('inf')
    return f'known to ±{share:.0%} only' if isfinite(share) and share < 1.0 else 'hardly known'
