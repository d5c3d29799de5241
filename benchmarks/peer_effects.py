"""Effects of the peer plant, in sizes that scale with the robot: 1 is a typical one.

Where the vocabulary leaves the law open there are several; a case's seed chooses among them, and
chooses signs, wheels and moments.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from peer_plant import Plant
from peer_robots import Make

DURATION = 120.0  # of a drive, over which what changes with time has its size [s]


@dataclass(frozen=True)
class Chance:
    """What a case draws once: one of two signs, a share from 0 to 1, an angle [rad], a law."""

    sign: float
    share: float
    angle: float
    law: int

    @property
    def left(self) -> bool:
        """Whether it is the left wheel that differs."""
        return self.share < 0.5


def chance(name: str, seed: int) -> Chance:
    """Draw what a case of an effect needs; laws take turns."""
    random = np.random.default_rng([seed, 4, *name.encode()])
    sign = float(random.choice([-1.0, 1.0]))
    return Chance(sign, random.uniform(), random.uniform(0.0, 2.0 * np.pi), seed)


# Each returns the plant's numbers that an effect of a size changes.
Law = Callable[[Make, float, Chance], dict[str, float]]


def _quadratic_drag(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'drag': size * 0.8 * make.push / make.terminal**2}


def _slope(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'rise_x': 0.015 * size * np.cos(c.angle), 'rise_y': 0.015 * size * np.sin(c.angle)}


def _yaw_friction(make: Make, size: float, c: Chance) -> dict[str, float]:
    p = make.plant
    both = {
        'yaw_dry': 0.3 * size * p.coulomb * p.half,
        'yaw_viscous': 0.25 * size * p.viscous * p.half**2,
    }
    return [both, {'yaw_dry': 1.5 * both['yaw_dry']}][c.law % 2]


def _wheel_friction_asymmetry(make: Make, size: float, c: Chance) -> dict[str, float]:
    share = 0.15 * size * c.sign
    return [{'left_dry': share, 'left_viscous': share}, {'left_dry': 1.3 * share}][c.law % 2]


def _direction_dependent_friction(make: Make, size: float, c: Chance) -> dict[str, float]:
    share = 0.35 * size * c.sign
    return [
        {'backward_dry': share, 'backward_viscous': 0.4 * share},
        {'backward_dry': 0.8 * share, 'backward_viscous': -0.3 * share},
    ][c.law % 2]


def _actuator_lag(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'lag': 0.08 * size}


def _actuator_delay(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'delay': 0.06 * size}


def _actuator_gain(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'gain_left' if c.left else 'gain_right': 1.0 + 0.08 * size * c.sign}


def _actuator_saturation(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'saturation': make.push * max(0.8 - 0.25 * size, 0.2)}


def _actuator_deadband(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'deadband': 0.12 * size * make.push}


def _actuator_fade(make: Make, size: float, c: Chance) -> dict[str, float]:
    return [{'fade': 0.25 * size / DURATION}, {'decay': 0.3 * size / DURATION}][c.law % 2]


def _force_bias(make: Make, size: float, c: Chance) -> dict[str, float]:
    bias = 0.2 * size * c.sign * make.plant.coulomb
    one = {'bias_left' if c.left else 'bias_right': bias}
    return [one, {'bias_right': 0.8 * bias, 'bias_left': 0.5 * bias}][c.law % 2]


def _payload_change(make: Make, size: float, c: Chance) -> dict[str, float]:
    share = 0.3 * size if c.sign > 0.0 else -0.2 * min(size, 3.0)
    return {
        'load_mass': share * make.plant.mass,
        'load_inertia': [1.0, 0.6][c.law % 2] * share * make.plant.inertia,
        'load_time': DURATION * (0.2 + 0.5 * c.share),
        'load_friction': [0.0, 1.0][c.law % 2] * share,
    }


def _com_offset(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'ahead': 0.1 * size * c.sign * make.plant.half}


def _wheel_ripple(make: Make, size: float, c: Chance) -> dict[str, float]:
    force, order = 0.8 * size * make.plant.coulomb, 1.0 + float(c.law % 3)
    one = {'ripple_left' if c.left else 'ripple_right': force}
    both = {'ripple_left': force, 'ripple_right': force}
    phases = {'phase_right': c.angle, 'phase_left': 2.0 * c.angle}
    return {**[one, both][c.law % 2], **phases, 'ripple_order': order}


def _friction_drift(make: Make, size: float, c: Chance) -> dict[str, float]:
    warmed = {'warming': -0.3 * min(size, 3.0), 'warm_time': DURATION * (0.15 + 0.3 * c.share)}
    return [warmed, {'wear': 0.35 * size / DURATION}][c.law % 2]


def _effective_track(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'half': make.plant.half * (1.0 + 0.05 * size * c.sign)}


def _power_limit(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'power': 0.25 * make.push * make.terminal / size}


def _voltage_limit(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'stall': make.push * [1.0, 1.3][c.law % 2], 'no_load': make.terminal / size}


def _speed_bump(make: Make, size: float, c: Chance) -> dict[str, float]:
    speed = 0.4 * make.terminal
    force = 1.5 * size * make.plant.coulomb
    return {'bump': force, 'bump_speed': speed, 'bump_width': 0.3 * speed}


def _rough_patch(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'patch': 0.5 * size * make.plant.coulomb}


def _puddle(make: Make, size: float, c: Chance) -> dict[str, float]:
    radius = 0.5 + 0.5 * c.share
    place = {'puddle_x': radius * np.cos(c.angle), 'puddle_y': radius * np.sin(c.angle)}
    return {'puddle': max(0.8 * size * c.sign, -0.9), 'puddle_radius': radius, **place}


def _carpet(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'carpet': 0.3 * size, 'carpet_time': DURATION * (0.2 + 0.35 * c.share)}


def _slip_loss(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'slip': min(0.3 * size, 0.8), 'slip_force': make.push}


def _sway(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'sway': 1.0 * size * make.plant.coulomb, 'sway_rate': 0.1 + 0.3 * c.share}


def _repeated_push(make: Make, size: float, c: Chance) -> dict[str, float]:
    force = 1.5 * size * c.sign * make.plant.coulomb
    return {'knock': force, 'knock_time': 0.4, 'knock_period': 2.0 + 3.0 * c.share}


def _shoves(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'shove': 4.0 * size * c.sign * make.plant.coulomb, 'shove_first': 5.0 + 4.0 * c.share}


def _coarse_force(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'coarse': 0.1 * size * make.push}


def _slew_limit(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'slew': 8.0 * make.push / size}


def _gear_loss(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'gear': min(0.15 * size, 0.5)}


def _settling_stiction(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'settling': 0.15 * size * make.plant.static}


def _tight_spot(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'tight': 1.0 * size, 'tight_right': c.angle, 'tight_left': 2.0 * c.angle}


def _caster(make: Make, size: float, c: Chance) -> dict[str, float]:
    trail, drag = 0.5 * make.plant.radius, 0.5 * size * make.plant.coulomb
    swivel = {'caster_swivel': drag * trail, 'caster_ahead': -1.5 * make.plant.half}
    return {'caster_roll': drag, 'caster_trail': trail, **swivel}


def _swinging_load(make: Make, size: float, c: Chance) -> dict[str, float]:
    share = min(0.15 * size, 0.5)
    rate = {'swing_rate': 0.7 + 1.5 * c.share, 'swing_damping': 0.05}
    return {'mass': (1.0 - share) * make.plant.mass, 'swing_mass': share * make.plant.mass, **rate}


def _veering_wind(make: Make, size: float, c: Chance) -> dict[str, float]:
    turn = c.sign * 2.0 * np.pi * (0.5 + c.share) / DURATION
    return {'wind': 0.15 * size * make.push, 'wind_angle': c.angle, 'wind_turn': turn}


def _ground_waves(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'wave': 0.03 * size * c.sign, 'wave_length': 1.0 + 2.0 * c.share}


def _mound(make: Make, size: float, c: Chance) -> dict[str, float]:
    radius = 0.4 + 0.3 * c.share
    place = {'mound_x': 2.0 * radius * np.cos(c.angle), 'mound_y': 2.0 * radius * np.sin(c.angle)}
    return {'mound': 0.03 * size * c.sign, 'mound_radius': radius, **place}


def _tether(make: Make, size: float, c: Chance) -> dict[str, float]:
    return {'tether': 0.1 * size * make.push, 'tether_slack': 0.5 + c.share}


EFFECTS: dict[str, Law] = {
    'quadratic_drag': _quadratic_drag,
    'slope': _slope,
    'yaw_friction': _yaw_friction,
    'wheel_friction_asymmetry': _wheel_friction_asymmetry,
    'direction_dependent_friction': _direction_dependent_friction,
    'actuator_lag': _actuator_lag,
    'actuator_delay': _actuator_delay,
    'actuator_gain': _actuator_gain,
    'actuator_saturation': _actuator_saturation,
    'actuator_deadband': _actuator_deadband,
    'actuator_fade': _actuator_fade,
    'force_bias': _force_bias,
    'payload_change': _payload_change,
    'com_offset': _com_offset,
    'wheel_ripple': _wheel_ripple,
    'friction_drift': _friction_drift,
    'effective_track': _effective_track,
    'power_limit': _power_limit,
    'voltage_limit': _voltage_limit,
}
FOREIGN: dict[str, Law] = {
    'speed_bump': _speed_bump,
    'rough_patch': _rough_patch,
    'puddle': _puddle,
    'carpet': _carpet,
    'slip_loss': _slip_loss,
    'sway': _sway,
    'repeated_push': _repeated_push,
    'shoves': _shoves,
    'coarse_force': _coarse_force,
    'slew_limit': _slew_limit,
    'gear_loss': _gear_loss,
    'settling_stiction': _settling_stiction,
    'tight_spot': _tight_spot,
    'caster': _caster,
    'swinging_load': _swinging_load,
    'veering_wind': _veering_wind,
    'ground_waves': _ground_waves,
    'mound': _mound,
    'tether': _tether,
}


def with_effect(plant: Plant, make: Make, name: str, size: float, seed: int) -> Plant:
    """Return a plant that has an effect of a size as well."""
    law = (EFFECTS | FOREIGN)[name]
    return plant._replace(**law(make, size, chance(name, seed)))
