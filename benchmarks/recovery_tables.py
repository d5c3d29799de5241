"""Markdown tables of what identification answered, beside what is true."""

from collections.abc import Callable, Iterator, Sequence
from math import hypot

import numpy as np
from recovery_cases import Row
from recovery_coverage import coverage


def told(row: Row) -> str:
    """Tell a case in one line."""
    mark = 'right' if right(row) else 'WRONG'
    answer = ', '.join(row['found']) or row['verdict']
    if row.get('unexplained'):
        answer += f' ({row["unexplained"]})'
    ratio = f'{over_ideal(row):.2f} × ideal' if 'ideal' in row else row['problem']
    return f'{mark}  {row["name"]}: {answer}; error {ratio}; {row.get("seconds", 0):.0f} s'


def right(row: Row) -> bool:
    """Say whether an answer is exactly what is true."""
    if row['family'] in ('removed', 'foreign'):
        return bool(row['verdict'] == 'unexplained')
    return exact(row)


def exact(row: Row) -> bool:
    """Say whether just the planted effects were found, and nothing was left unexplained."""
    answered = row['verdict'] != 'failed' and row['unexplained'] is None
    return bool(answered and sorted(row['found']) == sorted(row['effects']))


def reported(row: Row) -> bool:
    """Say whether every planted effect is among those found or one of their alternatives."""
    others = [name for names in row.get('alternatives', {}).values() for name in names]
    return set(row['effects']) <= {*row['found'], *others}


def over_ideal(row: Row) -> float:
    """Return the held-out error with the effects found, over that of the true plant."""
    return _norm(row['errors']['with_effects'], row) / _norm(row['ideal'], row)


def over_noise(row: Row) -> float:
    """Return the held-out error of the recalibrated nominal model, over the noise floor."""
    return _norm(row['errors']['recalibrated'], row)


def tables(rows: Sequence[Row]) -> str:
    """Render the tables of all families that have rows."""
    sections = [
        _section('Clean robots', _of(rows, 'clean'), ('make', 'floor'), CLEAN),
        _section('One effect', _of(rows, 'single'), ('effects', 'size', 'floor'), SINGLE),
        _section('One effect, by size', _of(rows, 'single'), ('size', 'floor'), SINGLE),
        _section('Two effects', _of(rows, 'pairs'), ('floor',), PAIRS),
        _section(
            'Effect taken out of the library', _of(rows, 'removed'), ('effects', 'floor'), NAMELESS
        ),
        _section('Effect of no vocabulary', _of(rows, 'foreign'), ('effects', 'floor'), NAMELESS),
        _section('Other drives', _of(rows, 'drives'), ('drive', 'make', 'floor'), DRIVEN),
        _section('Encoders and gyros', _of(rows, 'odometry'), ('effects', 'floor'), SENSED),
        _section('Wheels that creep', _of(rows, 'creeping'), ('effects', 'floor'), SENSED),
        _section('Controllers that hear more', _of(rows, 'heard'), ('effects', 'floor'), SENSED),
        _section('Detection over size', _of(rows, 'sizes'), ('effects', 'size', 'floor'), SINGLE),
        coverage(rows),
    ]
    return '\n\n'.join(section for section in sections if section)


Column = Callable[[Sequence[Row]], str]


def _share(holds: Callable[[Row], bool]) -> Column:
    return lambda group: f'{sum(map(holds, group))} of {len(group)}'


def _median(of: Callable[[Row], float]) -> Column:
    return lambda group: (
        f'{np.median([of(row) for row in group if "ideal" in row] or [np.nan]):.2f}'
    )


RATIOS: dict[str, Column] = {
    'error before / noise': _median(over_noise),
    'error after / ideal': _median(over_ideal),
}
CLEAN: dict[str, Column] = {
    'flagged': _share(lambda row: row['verdict'] != 'nothing_missing'),
    **RATIOS,
}
SINGLE: dict[str, Column] = {
    'reported': _share(reported),
    'first': _share(lambda row: row['found'][:1] == row['effects']),
    'exact': _share(exact),
    **RATIOS,
}
PAIRS: dict[str, Column] = {
    'both found': _share(lambda row: set(row['effects']) <= set(row['found'])),
    'exact': _share(exact),
    **RATIOS,
}
DRIVEN: dict[str, Column] = {
    'right and alone': _share(exact),
    'among alternatives': _share(lambda row: reported(row) and not exact(row)),
    'wrong name': _share(lambda row: bool(row['found']) and not reported(row)),
    'said nothing': _share(lambda row: row['verdict'] == 'nothing_missing' and not exact(row)),
    'unexplained': _share(lambda row: row['verdict'] == 'unexplained'),
}
SENSED: dict[str, Column] = {
    'right and alone': _share(exact),
    'wrong name': _share(lambda row: not set(row['found']) <= set(row['effects'])),
    'unexplained': _share(lambda row: row['unexplained'] is not None),
    **RATIOS,
}
NAMELESS: dict[str, Column] = {
    'unexplained': _share(lambda row: row['verdict'] == 'unexplained'),
    'wrong name': _share(lambda row: bool(row['found'])),
    **RATIOS,
}


def _of(rows: Sequence[Row], family: str) -> list[Row]:
    return [row for row in rows if row['family'] == family]


def _section(
    title: str, rows: Sequence[Row], keys: Sequence[str], columns: dict[str, Column]
) -> str:
    """Render a table: one line for each group of rows, and one for all of them."""
    if not rows:
        return ''
    lines = [f'## {title}', '', '| ' + ' | '.join([*keys, *columns]) + ' |']
    lines.append('|---' * (len(keys) + len(columns)) + '|')
    for label, group in _groups(rows, keys):
        lines.append('| ' + ' | '.join([*label, *(c(group) for c in columns.values())]) + ' |')
    return '\n'.join(lines)


def _groups(rows: Sequence[Row], keys: Sequence[str]) -> Iterator[tuple[list[str], list[Row]]]:
    labels = [tuple(_text(row[key]) for key in keys) for row in rows]
    for label in dict.fromkeys(labels):
        yield list(label), [row for row, own in zip(rows, labels, strict=True) if own == label]
    yield ['all', *[''] * (len(keys) - 1)], list(rows)


def _text(value: str | list[str]) -> str:
    return value if isinstance(value, str) else ' + '.join(value) or 'none'


def _norm(error: Row, row: Row) -> float:
    """Return an error in units of the noise floor, both velocities together."""
    floor = row['errors']['noise_floor']
    parts = (error[key] / floor[key] for key in ('v_rmse', 'omega_rmse'))
    return hypot(*parts) / hypot(1.0, 1.0)
