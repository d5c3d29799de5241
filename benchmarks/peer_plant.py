"""A differential drive of other make: what a robot is here, as plain numbers.

Neither equation of motion nor integrator is shared with diffbot_sim, so that identification is
judged on motions that its own simulator did not make. Every number that is 0 (a gain that is 1,
a limit that is infinite) switches its effect off.
"""

from math import inf
from typing import NamedTuple


class Plant(NamedTuple):
    """A robot with all that may act on it; SI units, wheels are named by side.

    inertia is about the centre of gravity, which lies `ahead` [m] of the axle. Friction of each
    wheel, odd in its speed w: (coulomb + (static − coulomb) e^(−stribeck |w|)) sign w + viscous w.
    """

    mass: float
    inertia: float
    half: float
    radius: float
    static: float
    coulomb: float
    viscous: float
    stribeck: float
    # Speed [m/s] up to which dry friction of a wheel grows instead of holding it at rest.
    creep: float = 0.0

    # Effects of the vocabulary. c [kg/m] in −c v |v|.
    drag: float = 0.0
    # How steeply the floor rises towards world x and y [rad].
    rise_x: float = 0.0
    rise_y: float = 0.0
    # Torque against turning [N·m], [N·m·s].
    yaw_dry: float = 0.0
    yaw_viscous: float = 0.0
    # By which share the left wheel's friction exceeds that of the right.
    left_dry: float = 0.0
    left_viscous: float = 0.0
    # By which share friction of a wheel that rolls backward exceeds that forward.
    backward_dry: float = 0.0
    backward_viscous: float = 0.0
    # From command to force [s]; a whole number of steps is taken for the delay.
    lag: float = 0.0
    delay: float = 0.0
    gain_right: float = 1.0
    gain_left: float = 1.0
    # [N]
    saturation: float = inf
    deadband: float = 0.0
    # Limits of a motor that drives: its power [W], and a force [N] that falls to nothing at a
    # speed [m/s].
    power: float = inf
    stall: float = inf
    no_load: float = inf
    # Force gain (1 − fade t) e^(−decay t) [1/s].
    fade: float = 0.0
    decay: float = 0.0
    # [N]
    bias_right: float = 0.0
    bias_left: float = 0.0
    # Load [kg, kg·m²] that is there from a moment [s] on, and by which share it raises friction.
    load_mass: float = 0.0
    load_inertia: float = 0.0
    load_time: float = 0.0
    load_friction: float = 0.0
    ahead: float = 0.0
    # Force [N] times sin(order × wheel angle + phase).
    ripple_right: float = 0.0
    ripple_left: float = 0.0
    ripple_order: float = 1.0
    phase_right: float = 0.0
    phase_left: float = 0.0
    # Friction times 1 + warming (1 − e^(−t / warm_time)) + wear t [-, s, 1/s].
    warming: float = 0.0
    warm_time: float = 1.0
    wear: float = 0.0

    # Effects that no vocabulary has. A force [N] against motion, greatest at ±bump_speed [m/s].
    bump: float = 0.0
    bump_speed: float = 1.0
    bump_width: float = 1.0
    # Dry friction of each wheel [N] on every second band of the floor across x, of a width [m].
    patch: float = 0.0
    patch_width: float = 1.0
    # By which share dry friction is larger, or smaller, within a radius [m] of a place [m].
    puddle: float = 0.0
    puddle_x: float = 0.0
    puddle_y: float = 0.0
    puddle_radius: float = 1.0
    # By which share friction is larger from a moment [s] on: another floor.
    carpet: float = 0.0
    carpet_time: float = 0.0
    # Share of the force that is lost at a force of slip_force [N]; it grows as the square.
    slip: float = 0.0
    slip_force: float = 1.0
    # A force [N] of a frequency [Hz] in time.
    sway: float = 0.0
    sway_rate: float = 0.0
    # A force [N] for knock_time [s] in every knock_period [s].
    knock: float = 0.0
    knock_time: float = 0.0
    knock_period: float = 1.0
    # A force [N] at shove_first [s] and later, there and back in turn: a hand.
    shove: float = 0.0
    shove_first: float = 1.0
    # Steps in which the force comes [N].
    coarse: float = 0.0
    # By how much a force changes in a second at most [N/s].
    slew: float = inf
    # Share of the force that a gear carries by which its dry friction grows.
    gear: float = 0.0
    # Dry friction of a wheel at rest [N]: settling ln(1 + rest / SETTLES) more.
    settling: float = 0.0
    # By which share dry friction of the wheels is larger somewhere in their turn, and where
    # [rad]: a bent axle rubs there.
    tight: float = 0.0
    tight_right: float = 0.0
    tight_left: float = 0.0
    # A caster: dry friction of rolling [N] and of swivelling [N·m], pivot ahead of the axle, and
    # how far it trails [m].
    caster_roll: float = 0.0
    caster_swivel: float = 0.0
    caster_ahead: float = 0.0
    caster_trail: float = 1.0
    # A load that swings along the robot [kg], how often [Hz], and its damping ratio.
    swing_mass: float = 0.0
    swing_rate: float = 0.0
    swing_damping: float = 0.0
    # Wind [N] whose direction turns, from an angle [rad] on, at a rate [rad/s].
    wind: float = 0.0
    wind_angle: float = 0.0
    wind_turn: float = 0.0
    # Ground in waves along x: how steep at most [rad], and how long [m].
    wave: float = 0.0
    wave_length: float = 1.0
    # A round mound [m], or a hollow: e^(−½) of its height at a radius [m] of a place [m].
    mound: float = 0.0
    mound_x: float = 0.0
    mound_y: float = 0.0
    mound_radius: float = 1.0
    # A tether that pulls back [N/m] beyond a length [m].
    tether: float = 0.0
    tether_slack: float = 0.0
