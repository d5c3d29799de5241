"""What a force without a law may depend on, and in which form that is looked at."""

import numpy as np

from diffbot_sim.identification.fitting.periodicity import wheel_orders
from diffbot_sim.identification.free_forms.caster import Caster
from diffbot_sim.identification.free_forms.commanded import COMMANDED
from diffbot_sim.identification.free_forms.forms import (
    FEW_KNOTS,
    GROWTH_KNOTS,
    SWITCHED_KNOTS,
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
)
from diffbot_sim.identification.free_forms.places import PLACES
from diffbot_sim.identification.free_forms.quantities import (
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
    WAYS,
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
from diffbot_sim.identification.free_forms.waves import LOOKED_AT, alone, rhythms, rubbing
from diffbot_sim.identification.free_forms.winding import Winding

# Speeds below which contacts creep or bend, and at which laws of Stribeck friction differ [m/s].
CREEPING = (0.0, 0.005, 0.02, 0.08)
NEAR_REST = ((0.0,), CREEPING)
# The same of yaw rates [rad/s].
TURNING_SLOWLY = (0.0, 0.02, 0.1, 0.4)
# Shares of the speed at which turning moves a wheel, within which one that rolls may turn back.
TURNING_BACK = ((0.0, 0.05), (0.0, 0.1))


MOTION = {
    'constant': Variable('nothing (it is always the same)', 'time [s]', Constant(), BODY),
    'v': Variable('the speed', 'speed v [m/s]', Piecewise(lambda view: view.v), BODY),
    'omega': Variable(
        'the yaw rate', 'turn rate ω [rad/s]', Piecewise(lambda view: view.omega), BODY
    ),
    'turning': Variable(
        'the yaw rate (alike to the left and to the right)',
        'turn rate ω [rad/s]',
        Odd(lambda view: view.omega),
        ('omega',),
    ),
    'cornering': Variable(
        'the product of speed and yaw rate',
        'v·ω [m/s²]',
        Piecewise(lambda view: view.v * view.omega),
        BODY,
    ),
    'heading': Variable(
        'the heading', 'heading [rad]', Periodic(lambda view: view.stretch.heading), BODY
    ),
    'turned': Variable(
        'how far it has turned in all',
        'heading [rad]',
        Piecewise(lambda view: view.stretch.heading),
        ('omega',),
    ),
    'friction_over_heading': Variable(
        'the heading, against the motion',
        'heading [rad]',
        Periodic(lambda view: view.stretch.heading, weights=rolling),
        ('wheels',),
    ),
    'time': Variable('time', 'time [s]', Piecewise(time), BODY),
    'pull': Variable(
        'time, like a pull that is fixed in the world and changes',
        'time [s]',
        Pull(time, counts=GROWTH_KNOTS),
        ('v',),
        parts=EACH_WAY,
    ),
    'rhythm': Variable(
        'time, the same again every {period:.3g} s',
        'phase [rad]',
        Periodic(lambda view: 2.0 * np.pi * view.stretch.time, rhythms, LOOKED_AT),
        BODY,
    ),
    'wheel_speed': Variable(
        "each wheel's speed",
        'speed of a wheel [m/s]',
        TwoSided(lambda view: view.wheel_speed),
        WHEELS,
    ),
    'rolling': Variable(
        "each wheel's speed (alike forward and backward)",
        'speed of a wheel [m/s]',
        Odd(lambda view: view.wheel_speed),
        WHEELS,
    ),
    'near_rest': Variable(
        "each wheel's speed near rest (alike forward and backward)",
        'speed of a wheel [m/s]',
        Near(lambda view: view.wheel_speed, sets=NEAR_REST),
        ('wheels',),
    ),
    'yielding': Variable(
        "each wheel's speed near rest, in proportion to the commanded force",
        'speed of a wheel, either way [m/s]',
        Fading(wheel_speeds, share_of_force, sets=(CREEPING,)),
        ('wheels',),
    ),
    'turning_near_rest': Variable(
        'the yaw rate near rest, against turning',
        'turn rate ω, either way [rad/s]',
        Fading(lambda view: np.abs(view.omega), turning, sets=(TURNING_SLOWLY,)),
        ('omega',),
    ),
    'arcs': Variable(
        'where in arcs each wheel turns back',
        'speed of a wheel over that of turning alone, either way [-]',
        Fading(share_of_turning, turning_of_wheels, sets=TURNING_BACK),
        ('wheels',),
    ),
    'rolling_one_way': Variable(
        "each wheel's speed (pushing the same way forward and backward)",
        'speed of a wheel, either way [m/s]',
        Piecewise(wheel_speeds, rolls),
        WHEELS,
    ),
    'wheel_angle': Variable(
        "each wheel's angle, at order {rate:.3g}",
        'angle of the wheel, times the order [rad]',
        Periodic(lambda view: view.wheel_angle, alone(wheel_orders), LOOKED_AT),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'friction_over_wheel_angle': Variable(
        "each wheel's angle, against the motion, at order {rate:.3g}",
        'angle of the wheel, times the order [rad]',
        Periodic(lambda view: view.wheel_angle, rubbing, LOOKED_AT, weights=rolling),
        ('wheels',),
        parts=EACH_WHEEL,
    ),
    'rest_before': Variable(
        'how long each wheel rested before it started',
        'rest of a wheel before it starts [ln s]',
        Growth(rest_before, started, FEW_KNOTS),
        ('wheels',),
    ),
    'way_since_reversal': Variable(
        'how far each wheel has rolled since it last turned back',
        'way of a wheel since it turned back [m]',
        Spans(rolled_since, rolling, WAYS),
        ('wheels',),
    ),
    'winding': Variable(
        'how far each wheel has wound up, which takes {rate:.3g} m of rolling',
        'way of a wheel since it turned back, wound up before [m]',
        Winding(),
        ('wheels',),
    ),
    'turn_since_reversal': Variable(
        'how far it has turned since it last turned the other way',
        'turn since ω changed its sign [rad]',
        Spans(turned_since, turning, ANGLES),
        ('omega',),
    ),
    'caster': Variable(
        'where a caster would have swivelled to',
        'rolling direction of a caster [rad]',
        Caster(),
        ('wheels',),
    ),
    'swing': Variable(
        'how something swings along the robot, {rate:.3g} times a second',
        'time after a jump of v by 1 m/s [s]',
        Swinging(lambda view: view.simulated[:, 0]),
        ('v',),
    ),
    'yaw_swing': Variable(
        'how something swings round with the robot, {rate:.3g} times a second',
        'time after a jump of ω by 1 rad/s [s]',
        Swinging(lambda view: view.simulated[:, 1]),
        ('omega',),
    ),
    'friction_over_time': Variable(
        'time, against the motion',
        'time [s]',
        Growth(time_of_wheels, rolling, SWITCHED_KNOTS),
        WHEELS,
    ),
    'warmth': Variable(
        'how much each wheel rolled in the last {rate:.3g} s, against the motion',
        'mean speed of a wheel lately, either way [m/s]',
        Warming(),
        ('wheels',),
    ),
}
VARIABLES = MOTION | COMMANDED | PLACES
# What is allowed for before anything is told, and not told itself; all the others are.
ALLOWED_FOR = ('near_rest', 'yielding')
# The same beside friction against turning, of which it is the part near rest.
ALLOWED_FOR_TURNING = 'turning_near_rest'
TOLD = tuple(name for name in VARIABLES if name not in (*ALLOWED_FOR, ALLOWED_FOR_TURNING))
