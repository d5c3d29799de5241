"""A bag whose recording was cut off to a good one with all that can be read."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from diffbot_sim.bags.copying import Saved, copy_messages
from diffbot_sim.bags.folder import STORAGE, whole_or_not_at_all
from diffbot_sim.bags.mending import BESIDE, mend
from diffbot_sim.bags.packed import is_packed, unpacked
from diffbot_sim.bags.storage import FORM, check_no_bags_below, naming, opened
from diffbot_sim.errors import BagError


@dataclass(frozen=True)
class Recovery:
    """What was saved, by topic; which topics had to be left out, for want of a definition."""

    was_whole: bool
    saved: Mapping[str, Saved]
    left_out: tuple[str, ...] = ()


def recover(bag: Path, out: Path) -> Recovery:
    """Write all that can be read of a bag (folder or file) to a new bag; the old one is kept.

    Raises BagError when nothing can be read, or out holds a recorded bag.
    """
    files, was_whole = _files(bag), is_whole(bag)
    with whole_or_not_at_all(out) as place:
        sources = [bag] if was_whole else _mended(files, place.parent)
        saved, left_out = copy_messages(sources, place)
        if not saved:
            raise BagError(f'{bag}: no message in it can be read. Record it again.')
    return Recovery(was_whole, saved, left_out)


def is_whole(bag: Path) -> bool:
    """Say whether a bag, or one of its files, can be read to the end."""
    if any(Path(f'{bag}{end}').exists() for end in BESIDE):
        return False
    try:
        with opened(bag) as reader:
            return sum(1 for _ in reader.messages()) == int(reader.message_count)
    except BagError:
        return False


def _files(bag: Path) -> list[Path]:
    """List the storage files of a bag, the second part before the tenth."""
    if not bag.exists():
        raise BagError(f'{bag}: there is no such bag.')
    with naming(bag):
        check_no_bags_below(bag)
    found = [bag] if bag.is_file() else [file for file in bag.rglob('*') if file.is_file()]
    whole = [file for file in found if file.suffix in STORAGE]
    # A recorder compresses parts that are finished, and then removes them.
    files = whole + [
        file for file in found if is_packed(file) and file.with_suffix('') not in whole
    ]
    if not files:
        raise BagError(f'{bag}: not a bag. {FORM}')
    for file in files:
        file.open('rb').close()  # to say now what may not be read
    return sorted(files, key=lambda file: [int(n) for n in re.findall(r'\d+', file.stem)])


def _mended(files: Iterable[Path], workplace: Path) -> Iterator[Path]:
    """Return the files, a mended copy in place of each that is cut; none where nothing is left.

    Compressed ones are unpacked first.
    """
    for number, given in enumerate(files):
        file = unpacked(given, workplace) if is_packed(given) else given
        copy = workplace / f'mended_{number}{file.suffix}'
        if is_whole(file):
            yield file
            continue
        mend(file, copy)
        if is_whole(copy):
            yield copy
