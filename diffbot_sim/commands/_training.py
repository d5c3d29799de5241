"""Training data: runs of a model, driven at random or as prescribed, written as tables."""

from argparse import Namespace
from collections.abc import Iterable

import numpy as np
from rich.console import Console
from rich.progress import track

from diffbot_sim.commands._recordings import check_out
from diffbot_sim.config import load_drive, load_model, save_drive, save_model
from diffbot_sim.drives import Drive, SegmentForces
from diffbot_sim.errors import DiffbotError
from diffbot_sim.physics import simulate
from diffbot_sim.tables import check_replaceable, columns_of, replacing, write_manifest, writer

RANDOM = 'random'


def write_training_data(arguments: Namespace) -> None:
    """Write the data set; run k is the same whatever the number of runs."""
    out, seed, runs = arguments.out, arguments.seed or 0, arguments.runs or 1
    check_out(out, [])
    check_replaceable(out)
    form = arguments.format or 'npz'
    write = writer(form)
    model, drive = load_model(arguments.params), _drive(arguments.drive, runs)
    seeds = {f'run_{number:04d}.{form}': run_seed(seed, number) for number in range(runs)}
    with replacing(out) as folder:
        save_model(model, folder / 'model.yaml', 'The model that was driven.')
        save_drive(drive, folder / 'drive.yaml', 'How it was driven, in every run.')
        for file in _with_progress(seeds):
            commands = drive.commands(seeds[file])
            motion = simulate(model, commands, drive.times)
            write(folder / file, columns_of(commands, motion))
        write_manifest(folder, seed, seeds)
    print(f'runs: {runs}, rows in each: {len(drive.times)}, seed: {seed}')
    print(f'data set: {out}')


def run_seed(seed: int, number: int) -> int:
    """Return the seed of a run, which depends on nothing but these two."""
    sequence = np.random.SeedSequence(seed, spawn_key=(number,))
    return int(sequence.generate_state(1, np.uint64)[0])


def _drive(source: str, runs: int) -> Drive:
    drive = Drive() if source == RANDOM else load_drive(source)
    if runs > 1 and isinstance(drive.forces, SegmentForces):
        raise DiffbotError(
            f'{source}: prescribes the forces, so all of {runs} runs would be the same. '
            "Leave out --runs, or give the file 'random:' in place of 'segments:'."
        )
    return drive


def _with_progress(files: Iterable[str]) -> Iterable[str]:
    """Show a bar on stderr where that is a terminal."""
    console = Console(stderr=True)
    hidden = not console.is_terminal
    return track(list(files), 'Simulating', console=console, transient=True, disable=hidden)
