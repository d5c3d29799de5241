"""A wrong answer with what led to it."""

from collections.abc import Iterator, Mapping

from recovery_cases import Row
from recovery_tables import told

SHOWN = 6  # candidates, the best ones and those planted


def evidence(row: Row) -> str:
    """Tell a case, what was planted, what was found, and how the candidates fared."""
    return '\n'.join([told(row), *_lines(row)])


def _lines(row: Row) -> Iterator[str]:
    yield f'  planted {_numbers(row["planted"])}'
    if row['verdict'] == 'failed':
        return
    for name in row['found']:
        values = {key: low_high[0] for key, low_high in row['parameters'][name].items()}
        yield f'  found {name}: {_numbers(values)}; {_numbers(row["evidence"][name])}'
        yield f'    alternatives: {", ".join(row["alternatives"][name]) or "none"}'
    for error in ('declared', 'recalibrated', 'with_effects', 'noise_floor'):
        yield f'  error {error}: {_numbers(row["errors"][error])}'
    yield f'  error of the truth: {_numbers(row["ideal"])}'
    for place, candidate in enumerate(row['candidates']):
        if place < SHOWN or candidate['name'] in row['effects']:
            yield _candidate(candidate)


def _candidate(candidate: Row) -> str:
    figures = {key: candidate[key] for key in ('score', 'p_value', 'p_block', 'held_out_gain')}
    values = _numbers(candidate['parameters'])
    return f'  {candidate["name"]} ({candidate["outcome"]}): {_numbers(figures)}; {values}'


def _numbers(values: Mapping[str, float]) -> str:
    return ', '.join(f'{key} {value:.3g}' for key, value in values.items())
