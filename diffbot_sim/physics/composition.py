"""Chains the kernels of a set of effects into one compiled function for each stage."""

import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any, NamedTuple
from uuid import uuid4

from diffbot_sim.physics.compiled import Function, Pointer, compiled, digest_of, entry
from diffbot_sim.physics.dynamics import SIGNATURES, Dynamics
from diffbot_sim.physics.effects import Effect
from diffbot_sim.physics.instant import EFFECTS, gather, nominal_balance, nominal_law
from diffbot_sim.physics.runge_kutta import runge_kutta
from diffbot_sim.physics.stages import Load, Stage, Traction


class _Link(NamedTuple):
    """One kernel of a chain and where its numbers stand in params and states."""

    kernel: Callable[..., Any]
    update: Callable[..., Any] | None
    first: int
    last: int
    first_state: int
    last_state: int


@cache
def compose(kinds: tuple[type[Effect], ...]) -> Dynamics:
    """Compile the functions for a set of effects, given in order of evaluation."""
    links, key = _links(kinds), _key(kinds)
    driving = links[Stage.COMMAND] + links[Stage.ACTUATOR] + links[Stage.DRIVETRAIN]
    parts = {
        'drive': driving,
        'rub': links[Stage.WHEEL_FRICTION],
        'push': links[Stage.BODY_LOAD],
        'weigh': links[Stage.INERTIA],
    }
    chains = {name: _chain(part, f'{name}_{key}') for name, part in parts.items()}
    bodies = Dynamics(
        laws=_bound(_laws, chains),
        settle=_bound(_settle, {'live': _settle_chain(driving, f'live_{key}')}),
        step=_bound(runge_kutta, {'laws': _known_as(f'laws_{key}')(_bound(_laws, chains))}),
    )
    pairs = zip(bodies, SIGNATURES, strict=True)
    return Dynamics(*(Pointer(entry(own, key)(body), own) for body, own in pairs))


def _key(kinds: tuple[type[Effect], ...]) -> str:
    """Return what tells a set from others, the state of its sources included."""
    files = {getattr(sys.modules[kind.__module__], '__file__', None) for kind in kinds}
    known = [Path(file) for file in files if file is not None]
    if len(known) < len(files):  # in a notebook a name may stand for another law at any time
        return uuid4().hex
    # Code on disk knows its module by name, and does not load where that has another one.
    return digest_of([f'{kind.__module__}.{kind.__qualname__}' for kind in kinds], known)


def _links(kinds: tuple[type[Effect], ...]) -> dict[Stage, tuple[_Link, ...]]:
    links: dict[Stage, tuple[_Link, ...]] = dict.fromkeys(Stage, ())
    first, state = EFFECTS, 0
    for kind in kinds:
        last, last_state = first + len(kind.specs()), state + kind.states
        link = _Link(kind.kernel, kind.update, first, last, state, last_state)
        links[kind.stage] += (link,)
        if kind.friction_kernel:
            links[Stage.WHEEL_FRICTION] += (link._replace(kernel=kind.friction_kernel),)
        first, state = last, last_state
    return links


def _chain(links: tuple[_Link, ...], name: str) -> Any:
    """Return a function that hands the value through every kernel in turn."""
    if not links:
        return _unchanged
    kernel, _, first, last, first_state, last_state = links[-1]
    name_here = f'{name}_{len(links)}'
    before = _chain(links[:-1], name)
    own = _numbers(first, last, f'{name_here}_own')
    state = _numbers(first_state, last_state, f'{name_here}_state')

    @_known_as(name_here)
    def chain(params, states, at, value):  # type: ignore[no-untyped-def]
        return kernel(at, before(params, states, at, value), *state(states), *own(params))

    return chain


def _numbers(first: int, last: int, name: str) -> Any:
    """Return a function that reads a part of an array as a tuple.

    One by one: slices would double the time of an evaluation.
    """
    if first == last:
        return _no_numbers
    before = _numbers(first, last - 1, name)

    @_known_as(f'{name}_{last}')
    def numbers(values):  # type: ignore[no-untyped-def]
        return (*before(values), values[last - 1])

    return numbers


@compiled
def _no_numbers(values):  # type: ignore[no-untyped-def]
    return ()


def _known_as(name: str) -> Callable[[Function], Any]:
    """Compile a function under a name that no other one has in any process.

    Machine code that several processes kept on disk is linked by name: of two functions that are
    called the same, the one loaded first would stand for both.
    """

    def decorate(function: Function) -> Any:
        function.__name__ = function.__qualname__ = name
        return compiled(function)

    return decorate


@compiled
def _unchanged(params, states, at, value):  # type: ignore[no-untyped-def]
    return value


def _settle_chain(links: tuple[_Link, ...], name: str) -> Any:
    """Return a function that writes the states reached after `at.elapsed` seconds."""
    if not any(link.update for link in links):
        return _unchanged
    settle_before = _settle_chain(links[:-1], name)
    _, update, first, last, first_state, last_state = links[-1]
    if update is None:
        return settle_before
    name_here, state_count = f'{name}_settle_{len(links)}', last_state - first_state
    before = _chain(links[:-1], name)
    own = _numbers(first, last, f'{name_here}_own')
    state = _numbers(first_state, last_state, f'{name_here}_state')

    @_known_as(name_here)
    def settle(params, states, at, value):  # type: ignore[no-untyped-def]
        fresh = update(at, before(params, states, at, value), *state(states), *own(params))
        settle_before(params, states, at, value)
        for index in range(state_count):
            states[first_state + index] = fresh[index]
        return value

    return settle


# The chains of a set without effects; _bound puts those of a set in their place.
drive = rub = push = weigh = live = _unchanged


def _laws(params, states, at, inputs, right, left):  # type: ignore[no-untyped-def]
    """Evaluate the stages of a set, one after the other: the body of every `Laws`."""
    traction = drive(params, states, at, Traction(inputs.right, inputs.left))
    load = push(params, states, at, Load(inputs.force, inputs.torque, 0.0, 0.0, 0.0))
    balance = weigh(params, states, at, nominal_balance(params, traction, load))
    law_right = rub(params, states, at, nominal_law(params, 1.0, right, traction.right, balance))
    law_left = rub(params, states, at, nominal_law(params, -1.0, left, traction.left, balance))
    return gather(params, traction, load, balance, law_right, law_left)


def _settle(params, states, at, inputs):  # type: ignore[no-untyped-def]
    """Move on the states of a set: the body of every `Settle`."""
    live(params, states, at, Traction(inputs.right, inputs.left))


def _bound(body: Function, chains: dict[str, Any]) -> Function:
    """Return a body with the chains of a set.

    As globals, not as a closure: numba would not recognise a closure on disk.
    """
    return FunctionType(body.__code__, {**body.__globals__, **chains}, body.__name__)
