"""One callable per command: the executables that setup.py installs for `ros2 run`."""

import sys
from functools import partial

from diffbot_sim.__main__ import main


def _run(command: str) -> int:
    return main(sys.argv[1:], command)


simulator = partial(_run, 'simulator')
pi_controller = partial(_run, 'pi_controller')
driver = partial(_run, 'driver')
recorder = partial(_run, 'recorder')
replay = partial(_run, 'replay')
simulate = partial(_run, 'simulate')
identify = partial(_run, 'identify')
recover = partial(_run, 'recover')
paper = partial(_run, 'paper')
demo = partial(_run, 'demo')
