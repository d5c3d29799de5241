"""Draws tuning.svg, the step responses that tuning.md speaks of, and prints their figures."""

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from make_picture import INK, PAPER, tidy
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from diffbot_sim.control.loop import Acceleration, InnerLoop, LoopSettings
from diffbot_sim.control.pi import Gains, wheel_rates
from diffbot_sim.physics import Model, Plant
from diffbot_sim.records import Array

TARGET = Path(__file__).with_name('tuning.svg')
TICK, SECONDS = 0.01, 4.0
PLAIN = LoopSettings()
SMOOTH = Acceleration(linear=0.6, angular=2.0)
# Each panel: the speed that is asked for [m/s], and what is compared.
PANELS = {
    'gains, a step to 0.5 m/s': (
        0.5,
        {
            'kp 1, ki 10': replace(PLAIN, pi=Gains(kp=1.0)),
            'kp 4, ki 10': PLAIN,
            'kp 4, ki 0': replace(PLAIN, pi=Gains(ki=0.0)),
        },
    ),
    'a step to 0.9 m/s, out of reach of 20 N': (
        0.9,
        {
            'tracking_time 0.2 s': PLAIN,
            'as good as none': replace(PLAIN, pi=Gains(tracking_time=1000.0)),
        },
    ),
    'limited to 0.6 m/s², weak gains': (
        0.5,
        {
            'without the model': replace(PLAIN, acceleration=SMOOTH, pi=Gains(kp=1.0, ki=5.0)),
            'feed_forward 1': replace(
                PLAIN, feed_forward=1.0, acceleration=SMOOTH, pi=Gains(kp=1.0, ki=5.0)
            ),
        },
    ),
    'from rest to 0.02 m/s: stiction': (
        0.02,
        {'kp 4, ki 10': PLAIN, 'feed_forward 1': replace(PLAIN, feed_forward=1.0)},
    ),
}
COLOURS = ('#8ab4f8', '#1a73e8', '#d93025')


def main() -> None:
    """Draw every panel."""
    mpl.rcParams.update({'font.size': 11, 'text.color': INK, 'svg.hashsalt': 'diffbot_sim'})
    figure = Figure(figsize=(9.0, 6.6), facecolor=PAPER, layout='constrained')
    for axes, (title, (wanted, compared)) in zip(
        figure.subplots(2, 2).flat, PANELS.items(), strict=True
    ):
        draw(axes, title, wanted, compared)
    figure.savefig(TARGET, dpi=100, metadata={'Date': None, 'Creator': None})


def draw(axes: Axes, title: str, wanted: float, compared: dict[str, LoopSettings]) -> None:
    """Draw the speeds of one panel, and print their figures."""
    for (name, settings), colour in zip(compared.items(), COLOURS, strict=False):
        time, v, reference = respond(settings, wanted)
        axes.plot(time, v, color=colour, lw=2.0, label=name)
        print(f'{title}; {name}: {figures(time, v, reference)}')
    axes.plot(time, reference, color=INK, lw=1.0, ls='--', label='reference')
    axes.set_title(title, fontsize=11, color=INK)
    axes.set_xlabel('time [s]', color=INK)
    axes.set_ylabel('v [m/s]', color=INK)
    axes.legend(frameon=False, loc='lower right')
    tidy(axes)


def respond(settings: LoopSettings, wanted: float) -> tuple[Array, Array, Array]:
    """Drive the default robot from rest; return time [s], v and its reference [m/s]."""
    robot, loop = settings.robot, InnerLoop()
    plant = Plant(Model(robot, settings.friction))
    rates = wheel_rates(wanted, 0.0, robot)
    rows = []
    for tick in range(round(SECONDS / TICK)):
        v = plant.twist[0]
        output = loop.step(settings, rates, wheel_rates(v, plant.twist[1], robot), TICK)
        rows.append((tick * TICK, v, output.reference[0] * robot.wheel_radius))
        plant.step(*output.force, TICK)
    time, v, reference = np.array(rows).T
    return time, v, reference


def figures(time: Array, v: Array, reference: Array) -> str:
    """Tell rise time, overshoot and what is missed."""
    end = reference[-1]
    rise = time[np.argmax(v >= 0.9 * end)] if (v >= 0.9 * end).any() else np.inf
    over, missed = max(v.max() / end - 1.0, 0.0), np.abs(v - reference).max()
    return f'90 % after {rise:.2f} s, overshoot {over:.1%}, largest error {missed:.3f} m/s'


if __name__ == '__main__':
    main()
