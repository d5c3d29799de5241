"""What a force may depend on: what the wheels are commanded to do."""

import numpy as np

from diffbot_sim.identification.fitting.periodicity import force_rates, gain_rates
from diffbot_sim.identification.free_forms.forms import (
    BENT_KNOTS,
    GROWTH_KNOTS,
    SWITCHED_KNOTS,
    Growth,
    Periodic,
    Piecewise,
    Spans,
)
from diffbot_sim.identification.free_forms.past import Changes, Past
from diffbot_sim.identification.free_forms.quantities import (
    driving,
    others_force,
    power,
    rolling,
    share_of_force,
    time_of_wheels,
    wheel_speeds,
)
from diffbot_sim.identification.free_forms.turning_back import TIMES, driven_since
from diffbot_sim.identification.free_forms.variable import EACH_WHEEL, WHEELS, Variable
from diffbot_sim.identification.free_forms.waves import LOOKED_AT, alone

COMMANDED = {
    'wheel_force': Variable(
        "each wheel's commanded force",
        "a wheel's commanded force [N]",
        Piecewise(lambda view: view.force),
        WHEELS,
    ),
    # What acts on both wheels alike is another mass and inertia.
    'other_force': Variable(
        "the other wheel's commanded force",
        "the other wheel's commanded force [N]",
        Piecewise(others_force),
        ('difference',),
    ),
    'force_steps': Variable(
        "each wheel's commanded force, as if it came in steps of {period:.3g} N",
        'command over its step, as a phase [rad]',
        Periodic(lambda view: 2.0 * np.pi * view.force, alone(force_rates), LOOKED_AT),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'drive': Variable(
        'how hard each wheel is driven or braked, against the motion',
        'force that drives a wheel, or brakes it [N]',
        Piecewise(driving, rolling, BENT_KNOTS),
        ('wheels',),
    ),
    'force_over_speed': Variable(
        "each wheel's speed, in proportion to the commanded force",
        'speed of a wheel, either way [m/s]',
        Growth(wheel_speeds, share_of_force, GROWTH_KNOTS),
        ('wheels',),
    ),
    'force_over_power': Variable(
        'the power that each wheel is asked for, in proportion to the commanded force',
        'power asked of a wheel, or, below zero, taken [W]',
        Growth(power, share_of_force, GROWTH_KNOTS),
        ('wheels',),
    ),
    'force_change': Variable(
        "how far each wheel's commanded force has just changed",
        'age of the command [s]',
        Changes(),
        ('wheels',),
    ),
    'past_force': Variable(
        "the past of each wheel's commanded force", 'age of the command [s]', Past(), WHEELS
    ),
    'time_since_reversal': Variable(
        "for how long each wheel's commanded force has had its sign",
        'time since the command changed its sign [s]',
        Spans(driven_since, lambda view: np.sign(view.force), TIMES),
        ('wheels',),
    ),
    'force_over_time': Variable(
        'time, in proportion to the commanded force',
        'time [s]',
        Growth(time_of_wheels, share_of_force, SWITCHED_KNOTS),
        WHEELS,
    ),
    'gain_rhythm': Variable(
        'time, the same again every {period:.3g} s, in proportion to the commanded force',
        'phase [rad]',
        Periodic(
            lambda view: 2.0 * np.pi * time_of_wheels(view),
            alone(gain_rates),
            LOOKED_AT,
            weights=share_of_force,
        ),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
}
