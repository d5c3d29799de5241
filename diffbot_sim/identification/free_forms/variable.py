"""What a force may depend on: a variable in words, and the form in which it is looked at."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from diffbot_sim.identification.free_forms.floor import Order, in_time
from diffbot_sim.identification.free_forms.forms import Form
from diffbot_sim.identification.recordings.stretches import Stretch

# Axes of what acts on the body, and on each wheel.
BODY, WHEELS = ('v', 'omega'), ('wheels', 'difference')
# What has functions of its own: the force as a whole, or on each wheel, or each way in the world.
WHOLE = ('',)
EACH_WHEEL = ('on the right wheel', 'on the left wheel')
EACH_WAY = ('along x', 'along y')


@dataclass(frozen=True)
class Variable:
    """A variable in words, its form, and along which axes a force may depend on it.

    words: grid stands for the numbers that the functions are laid on, rate and period for those of
    the slowest wave; over: what its curve is drawn over, with the unit; order: in which
    samples are cut into parts that must agree; parts: what has functions of its own, which follow
    each other in this order.
    """

    words: str
    over: str
    form: Form
    axes: tuple[str, ...]
    order: Callable[[Sequence[Stretch]], Order] = in_time
    parts: tuple[str, ...] = WHOLE
