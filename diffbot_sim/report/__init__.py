"""From what identification concludes to what people and programs read."""

from diffbot_sim.report.origin import Origin, origin_of
from diffbot_sim.report.terminal import print_summary
from diffbot_sim.report.writing import write_report

__all__ = ['Origin', 'origin_of', 'print_summary', 'write_report']
