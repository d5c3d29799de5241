"""Parts of a bag that were compressed as whole files, as `--compression-mode file` does."""

from contextlib import suppress
from pathlib import Path

from zstandard import ZstdDecompressor, ZstdError

from diffbot_sim.bags.folder import PACKED, is_part


def is_packed(file: Path) -> bool:
    """Say whether a file is a compressed part of a bag."""
    return file.suffix == PACKED and is_part(file)


def unpacked(file: Path, folder: Path) -> Path:
    """Unpack a file into a folder, up to where it is cut; return the new file."""
    target = folder / file.with_suffix('').name
    with file.open('rb') as source, target.open('wb') as sink, suppress(ZstdError):
        ZstdDecompressor().copy_stream(source, sink)
    return target
