"""What a force without a law may depend on, and in which form that is looked at."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from diffbot_sim.identification.fitting.periodicity import (
    TEETH,
    force_rates,
    gain_rates,
    rates,
    repeats,
    rubbing_orders,
    wheel_orders,
)
from diffbot_sim.identification.fitting.views import View
from diffbot_sim.identification.free_forms.caster import Caster
from diffbot_sim.identification.free_forms.forms import (
    BENT_KNOTS,
    FEW_KNOTS,
    GROWTH_KNOTS,
    Constant,
    Fading,
    Growth,
    Near,
    Odd,
    Periodic,
    Piecewise,
    Pull,
    Spans,
    TwoSided,
    Waves,
)
from diffbot_sim.identification.free_forms.past import Changes, Past
from diffbot_sim.identification.free_forms.places import PLACES
from diffbot_sim.identification.free_forms.quantities import (
    driving,
    others_force,
    power,
    rolling,
    rolls,
    share_of_force,
    share_of_turning,
    time,
    time_of_wheels,
    turning,
    turning_of_wheels,
    wheel_speeds,
)
from diffbot_sim.identification.free_forms.starting import rest_before, started
from diffbot_sim.identification.free_forms.swinging import Swinging
from diffbot_sim.identification.free_forms.turning_back import (
    ANGLES,
    TIMES,
    WAYS,
    driven_since,
    rolled_since,
    turned_since,
)
from diffbot_sim.identification.free_forms.variable import (
    BODY,
    EACH_WAY,
    EACH_WHEEL,
    WHEELS,
    Variable,
)
from diffbot_sim.identification.free_forms.warmth import Warming
from diffbot_sim.identification.free_forms.winding import Winding

# Rates that differ by a line width, among which the strongest were chosen; a generous count.
LOOKED_AT = 1000
# Speeds below which contacts creep or bend, and at which laws of Stribeck friction differ [m/s].
CREEPING = (0.0, 0.005, 0.02, 0.08)
NEAR_REST = ((0.0,), CREEPING)
# The same of yaw rates [rad/s].
TURNING_SLOWLY = (0.0, 0.02, 0.1, 0.4)
# Shares of the speed at which turning moves a wheel, within which one that rolls may turn back.
TURNING_BACK = ((0.0, 0.05), (0.0, 0.1))


def _alone(rates: Callable[[Sequence[View]], Sequence[float]]) -> Waves:
    """Return what gives each rate as a wave of its own."""
    return lambda seen: [(rate,) for rate in rates(seen)]


def _rhythms(seen: Sequence[View]) -> list[tuple[float, ...]]:
    """Return single waves, and short pushes: waves with their harmonics, and their mean."""
    return [*_alone(rates)(seen), *((*_harmonics(rate), 0.0) for rate in repeats(seen))]


def _rubbing(seen: Sequence[View]) -> list[tuple[float, ...]]:
    """Return single waves of a wheel's angle, and tight spots: waves with their harmonics."""
    waves = _alone(partial(rubbing_orders, teeth=1))(seen)
    return [*waves, *map(_harmonics, rubbing_orders(seen, TEETH))]


def _harmonics(rate: float) -> tuple[float, ...]:
    return tuple(rate * h for h in range(1, TEETH + 1))


VARIABLES = {
    'constant': Variable('nothing (it is always the same)', Constant(), BODY),
    'v': Variable('the speed', Piecewise(lambda view: view.v), BODY),
    'omega': Variable('the yaw rate', Piecewise(lambda view: view.omega), BODY),
    'turning': Variable(
        'the yaw rate (alike to the left and to the right)',
        Odd(lambda view: view.omega),
        ('omega',),
    ),
    'cornering': Variable(
        'the product of speed and yaw rate', Piecewise(lambda view: view.v * view.omega), BODY
    ),
    'heading': Variable('the heading', Periodic(lambda view: view.stretch.heading), BODY),
    'turned': Variable(
        'how far it has turned in all', Piecewise(lambda view: view.stretch.heading), ('omega',)
    ),
    'friction_over_heading': Variable(
        'the heading, against the motion',
        Periodic(lambda view: view.stretch.heading, weights=rolling),
        ('wheels',),
    ),
    'time': Variable('time', Piecewise(time), BODY),
    'pull': Variable(
        'time, like a pull that is fixed in the world and changes',
        Pull(time, counts=GROWTH_KNOTS),
        ('v',),
        parts=EACH_WAY,
    ),
    'rhythm': Variable(
        'time, the same again every {period:.3g} s',
        Periodic(lambda view: 2.0 * np.pi * view.stretch.time, _rhythms, LOOKED_AT),
        BODY,
    ),
    'wheel_speed': Variable(
        "each wheel's speed",
        TwoSided(lambda view: view.wheel_speed),
        WHEELS,
    ),
    'rolling': Variable(
        "each wheel's speed (alike forward and backward)",
        Odd(lambda view: view.wheel_speed),
        WHEELS,
    ),
    'near_rest': Variable(
        "each wheel's speed near rest (alike forward and backward)",
        Near(lambda view: view.wheel_speed, sets=NEAR_REST),
        ('wheels',),
    ),
    'yielding': Variable(
        "each wheel's speed near rest, in proportion to the commanded force",
        Fading(wheel_speeds, share_of_force, sets=(CREEPING,)),
        ('wheels',),
    ),
    'turning_near_rest': Variable(
        'the yaw rate near rest, against turning',
        Fading(lambda view: np.abs(view.omega), turning, sets=(TURNING_SLOWLY,)),
        ('omega',),
    ),
    'arcs': Variable(
        'where in arcs each wheel turns back',
        Fading(share_of_turning, turning_of_wheels, sets=TURNING_BACK),
        ('wheels',),
    ),
    'rolling_one_way': Variable(
        "each wheel's speed (pushing the same way forward and backward)",
        Piecewise(wheel_speeds, rolls),
        WHEELS,
    ),
    'wheel_angle': Variable(
        "each wheel's angle, at order {rate:.3g}",
        Periodic(lambda view: view.wheel_angle, _alone(wheel_orders), LOOKED_AT),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'friction_over_wheel_angle': Variable(
        "each wheel's angle, against the motion, at order {rate:.3g}",
        Periodic(lambda view: view.wheel_angle, _rubbing, LOOKED_AT, weights=rolling),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'wheel_force': Variable(
        "each wheel's commanded force", Piecewise(lambda view: view.force), WHEELS
    ),
    # What acts on both wheels alike is another mass and inertia.
    'other_force': Variable(
        "the other wheel's commanded force",
        Piecewise(others_force),
        ('difference',),
    ),
    'force_steps': Variable(
        "each wheel's commanded force, as if it came in steps of {period:.3g} N",
        Periodic(lambda view: 2.0 * np.pi * view.force, _alone(force_rates), LOOKED_AT),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'drive': Variable(
        'how hard each wheel is driven or braked, against the motion',
        Piecewise(driving, rolling, BENT_KNOTS),
        ('wheels',),
    ),
    'force_over_speed': Variable(
        "each wheel's speed, in proportion to the commanded force",
        Growth(wheel_speeds, share_of_force, GROWTH_KNOTS),
        ('wheels',),
    ),
    'force_over_power': Variable(
        'the power that each wheel is asked for, in proportion to the commanded force',
        Growth(power, share_of_force, GROWTH_KNOTS),
        ('wheels',),
    ),
    'force_change': Variable(
        "how far each wheel's commanded force has just changed", Changes(), ('wheels',)
    ),
    'past_force': Variable("the past of each wheel's commanded force", Past(), WHEELS),
    'rest_before': Variable(
        'how long each wheel rested before it started',
        Growth(rest_before, started, FEW_KNOTS),
        ('wheels',),
    ),
    'way_since_reversal': Variable(
        'how far each wheel has rolled since it last turned back',
        Spans(rolled_since, rolling, WAYS),
        ('wheels',),
    ),
    'winding': Variable(
        'how far each wheel has wound up, which takes {rate:.3g} m of rolling',
        Winding(),
        ('wheels',),
    ),
    'time_since_reversal': Variable(
        "for how long each wheel's commanded force has had its sign",
        Spans(driven_since, lambda view: np.sign(view.force), TIMES),
        ('wheels',),
    ),
    'turn_since_reversal': Variable(
        'how far it has turned since it last turned the other way',
        Spans(turned_since, turning, ANGLES),
        ('omega',),
    ),
    'caster': Variable('where a caster would have swivelled to', Caster(), ('wheels',)),
    'swing': Variable(
        'how something swings along the robot, {rate:.3g} times a second',
        Swinging(lambda view: view.simulated[:, 0]),
        ('v',),
    ),
    'yaw_swing': Variable(
        'how something swings round with the robot, {rate:.3g} times a second',
        Swinging(lambda view: view.simulated[:, 1]),
        ('omega',),
    ),
    'force_over_time': Variable(
        'time, in proportion to the commanded force',
        Growth(time_of_wheels, share_of_force, GROWTH_KNOTS),
        WHEELS,
    ),
    'gain_rhythm': Variable(
        'time, the same again every {period:.3g} s, in proportion to the commanded force',
        Periodic(
            lambda view: 2.0 * np.pi * time_of_wheels(view),
            _alone(gain_rates),
            LOOKED_AT,
            weights=share_of_force,
        ),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'friction_over_time': Variable(
        'time, against the motion', Growth(time_of_wheels, rolling, GROWTH_KNOTS), WHEELS
    ),
    'warmth': Variable(
        'how much each wheel rolled in the last {rate:.3g} s, against the motion',
        Warming(),
        ('wheels',),
    ),
} | PLACES
# What is allowed for before anything is told, and not told itself; all the others are.
ALLOWED_FOR = ('near_rest', 'yielding')
# The same beside friction against turning, of which it is the part near rest.
ALLOWED_FOR_TURNING = 'turning_near_rest'
TOLD = tuple(name for name in VARIABLES if name not in (*ALLOWED_FOR, ALLOWED_FOR_TURNING))
