"""How often identification is right, on drives of a plant that it does not know.

python benchmarks/recovery.py --family clean --seeds 0:2     run cases; those done are skipped
python benchmarks/recovery.py --family pairs --share 0.1     a tenth of them, always the same
python benchmarks/recovery.py --table                        what all cases so far add up to
python benchmarks/recovery.py --wrong                        on which evidence answers were wrong
"""

import json
import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path

from recovery_cases import FAMILIES, Case, Row, cases
from recovery_evidence import evidence
from recovery_judge import judge
from recovery_tables import right, tables, told

from diffbot_sim.__main__ import THREADS as LINEAR_ALGEBRA

# Each process has one thread for every library; `identify` has a few of its own.
THREADS = ('NUMBA_NUM_THREADS', *LINEAR_ALGEBRA)


def main() -> None:
    """Judge the chosen cases that have not been, or tell what all of them say."""
    options = _options()
    if options.table:
        print(tables(_judged_before(options.out)))
    elif options.wrong:
        print('\n\n'.join(evidence(row) for row in _judged_before(options.out) if not right(row)))
    else:
        _judge(options)


def _judge(options: Namespace) -> None:
    done = {row['name'] for row in rows(options.out)}
    chosen = cases(options.family or list(FAMILIES), options.seeds, options.share)
    if options.only is not None:
        chosen = (case for case in chosen if options.only in case.name)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    with options.out.open('a') as file:
        for row in judged([c for c in chosen if c.name not in done], options.processes):
            file.write(json.dumps(row) + '\n')
            file.flush()
            print(told(row), flush=True)


def _judged_before(path: Path) -> list[Row]:
    known = rows(path)
    if not known:
        raise SystemExit(f'{path}: no cases yet. Judge some first, with --family and --seeds.')
    return known


def rows(path: Path) -> list[Row]:
    """Read the rows of all cases judged so far."""
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def judged(chosen: Iterable[Case], processes: int) -> Iterable[Row]:
    """Judge cases in processes of one thread each; rows come as they are ready."""
    os.environ.update(dict.fromkeys(THREADS, '1'))
    with ProcessPoolExecutor(processes, get_context('spawn')) as pool:
        for future in as_completed([pool.submit(judge, case) for case in chosen]):
            yield future.result()


def _options() -> Namespace:
    parser = ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--family', nargs='+', choices=FAMILIES, help='default: all of them')
    parser.add_argument('--seeds', type=seed_range, default=range(1), help='FIRST:END or a number')
    parser.add_argument('--share', type=float, default=1.0, help='of the cases, at random')
    parser.add_argument('--only', help='cases whose name contains this')
    parser.add_argument('--processes', type=int, default=1)
    parser.add_argument('--out', type=Path, default=Path('out/recovery.jsonl'))
    parser.add_argument('--table', action='store_true', help='print Markdown tables, run nothing')
    parser.add_argument('--wrong', action='store_true', help='print wrong answers, run nothing')
    return parser.parse_args()


def seed_range(text: str) -> range:
    """Read FIRST:END, or a number of seeds."""
    return range(*(int(part) for part in text.split(':')))


if __name__ == '__main__':
    main()
