"""The report's files."""

from pathlib import Path

from diffbot_sim.files import write_whole
from diffbot_sim.identification.result import Identification
from diffbot_sim.report.json_report import json_text
from diffbot_sim.report.origin import Origin
from diffbot_sim.report.page import page_text


def write_report(result: Identification, origin: Origin, out: Path) -> None:
    """Write report.json and report.html into a folder, which is made where it lacks.

    Raises OSError when the folder cannot be written.
    """
    texts = {'report.json': json_text(result, origin), 'report.html': page_text(result, origin)}
    out.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        write_whole(out / name, text)
