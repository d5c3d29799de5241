"""The residual bag: what was measured, what each model predicts, and what is between."""

import re
from collections.abc import Mapping, Sequence

from diffbot_sim.identification.result import Comparison
from diffbot_sim.records import NANOSECONDS, Array

Series = dict[str, tuple[Array, Array]]


def residual_series(comparisons: Sequence[Comparison], offsets: Mapping[str, int]) -> Series:
    """Return times [s] and values by topic, for write_series.

    offsets: start of each run after the first one [ns], by name. Each run has a namespace of
    its own where there are several.
    """
    several = len(comparisons) > 1
    merged: Series = {}
    for i, item in enumerate(comparisons):
        prefix = f'/{_namespace(i, item.run)}' if several else ''
        time = item.time + offsets.get(item.run, 0) / NANOSECONDS
        merged |= {f'{prefix}/{topic}': (time, rows) for topic, rows in _values(item).items()}
    return merged


def _values(item: Comparison) -> dict[str, Array]:
    models = {
        'declared': item.declared.twist,
        'recalibrated': item.recalibrated.twist,
        'with_effects': item.with_effects.twist,
    }
    return {
        'measured/twist': item.twist,
        **{f'{name}/twist': twist for name, twist in models.items()},
        **{f'residual/{name}/twist': item.twist - twist for name, twist in models.items()},
        'residual/with_effects/wrench': item.disturbance,
    }


def _namespace(index: int, name: str) -> str:
    """Make a legal ROS namespace of a run's name; the number keeps namespaces apart."""
    return f'run_{index + 1}_' + re.sub(r'\W+', '_', name, flags=re.ASCII).strip('_')
