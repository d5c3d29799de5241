"""From what identification concludes to what people and programs read."""

from diffbot_sim.report.terminal import print_summary
from diffbot_sim.report.writing import write_report

__all__ = ['print_summary', 'write_report']
