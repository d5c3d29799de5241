"""The PI law reaches its reference, keeps its limit and does not wind up."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.control.held import Held
from diffbot_sim.control.loop import InnerLoop, LoopSettings
from diffbot_sim.control.pi import Gains, control, wheel_rates
from diffbot_sim.physics import Model, Plant, Robot

GAINS = Gains()
DT = 0.01
speeds = st.floats(-100.0, 100.0)
sums = st.floats(-100.0, 100.0)


def follow(reference: float, seconds: float, rate: float = 0.0, pull: float = 3.0) -> list[float]:
    """Drive a wheel that carries 5 kg against a constant pull [N]; return its rates [rad/s]."""
    integral, rates = 0.0, [rate]
    for _ in range(round(seconds / DT)):
        force, integral = control(GAINS, integral, reference, rates[-1], DT)
        rates.append(rates[-1] + (force - pull) / 5.0 / 0.08 * DT)
    return rates


@pytest.mark.parametrize('reference', [-8.0, 0.5, 8.0])
def test_the_wheel_reaches_its_reference_against_a_constant_pull(reference):
    assert follow(reference, 5.0)[-1] == pytest.approx(reference, abs=1e-3)


def test_a_long_time_at_the_limit_leaves_nothing_to_unwind():
    rates = follow(50.0, 10.0)
    assert max(rates) < 50.0 * 1.05


@pytest.mark.parametrize(('wrong', 'ticks'), [(500.0, 1), (5.0, 20), (1e6, 1)])
def test_a_wrong_reference_for_a_moment_never_drives_a_robot_backwards(wrong, ticks):
    loop, plant, speeds = InnerLoop(), Plant(Model()), []
    for tick in range(400):
        wanted = wrong if 100 <= tick < 100 + ticks else 0.3
        rates = (wheel_rates(v, 0.0, Robot()) for v in (wanted, plant.twist[0]))
        plant.step(*loop.step(LoopSettings(), *rates, DT).force, DT)
        speeds.append(plant.twist[0])
    assert min(speeds) >= 0.0
    assert speeds[-1] == pytest.approx(0.3, abs=0.01)


@given(speeds, speeds, sums, st.floats(0.0, 10.0))
def test_the_force_keeps_its_limit(reference, measured, integral, dt):
    force, _ = control(GAINS, integral, reference, measured, dt)
    assert abs(force) <= GAINS.force_limit


@given(speeds, speeds, sums)
def test_the_law_is_odd(reference, measured, integral):
    force, rest = control(GAINS, integral, reference, measured, DT)
    mirrored = control(GAINS, -integral, -reference, -measured, DT)
    assert mirrored == (-force, -rest)


@given(speeds, speeds, st.floats(-20.0, 20.0))
def test_no_time_adds_nothing_to_the_integral(reference, measured, integral):
    assert control(GAINS, integral, reference, measured, 0.0)[1] == integral


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), sums, st.floats(0.0, 1e3))
def test_the_integral_alone_keeps_the_limit(reference, measured, integral, dt):
    _, rest = control(GAINS, integral, reference, measured, dt)
    assert abs(rest) <= GAINS.force_limit


def test_wheel_rates_turn_a_twist_into_wheel_speeds():
    robot = Robot(wheel_separation=0.5, wheel_radius=0.1)
    assert wheel_rates(1.0, 2.0, robot) == pytest.approx((15.0, 5.0))


def test_a_command_holds_until_it_is_stale():
    command = Held(3.0, stamp=1_000_000_000)
    assert command.at(1_500_000_000, timeout=0.5) == 3.0
    assert command.at(1_500_000_001, timeout=0.5) == 0.0
    assert command.at(10**15, timeout=0.0) == 3.0
