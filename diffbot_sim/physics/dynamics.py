"""What a set of effects is compiled to: three functions, and how compiled code calls them."""

from collections.abc import Callable
from typing import NamedTuple

from numba import types

from diffbot_sim.physics.instant import Inputs, Instant
from diffbot_sim.physics.stages import Motion, numba_type

ARRAY = types.Array(types.float64, 1, 'C')
MATRIX = types.Array(types.float64, 2, 'C')
# The same with other numbers in between: rows and columns of larger arrays.
STRIDED_ARRAY = types.Array(types.float64, 1, 'A')
STRIDED_MATRIX = types.Array(types.float64, 2, 'A')
INTEGERS = types.Array(types.int64, 1, 'C')

# (params, states, motion, inputs, right, left): all that bears on the robot, where right and left
# are the directions in which the wheels roll or are pushed.
Laws = Callable[..., Instant]
# (params, states, motion, inputs): writes the states reached after motion.elapsed.
Settle = Callable[..., None]
# (params, states, z, modes, inputs, time, h, work): one step, as runge_kutta takes it.
Step = Callable[..., bool]


class Dynamics(NamedTuple):
    """The functions of a set of effects: of an instant, of the effects' states, of a smooth step.

    A call of one costs as much as some of the laws behind it, so a step is a single one.
    """

    laws: Laws
    settle: Settle
    step: Step


_PLACE = (ARRAY, ARRAY, numba_type(Motion), numba_type(Inputs))
_SPAN = (numba_type(Inputs), types.float64, types.float64)
SIGNATURES = Dynamics(
    laws=numba_type(Instant)(*_PLACE, types.float64, types.float64),
    settle=types.void(*_PLACE),
    step=types.boolean(ARRAY, ARRAY, ARRAY, INTEGERS, *_SPAN, MATRIX),
)
FUNCTION_TYPES = tuple(types.FunctionType(signature) for signature in SIGNATURES)
