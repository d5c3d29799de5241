"""payload_change: v = F t / m before the moment, and with the new mass after it."""

import numpy as np
from motion import commands, drive, push

from diffbot_sim.physics import Friction, Model, Plant, Robot, simulate
from diffbot_sim.physics.effects.payload_change import PayloadChange

SMOOTH = Friction('none')


def test_acceleration_changes_at_the_moment_whatever_the_step():
    model = Model(friction=SMOOTH, effects=(PayloadChange(5.0, 0.0, 1.2345),))
    for step in (1e-3, 0.02, 0.3):
        run = push(model, 5.0, 5.0, 3.0, every=0.5, max_step=step)
        early, late = np.minimum(run.time, 1.2345), np.maximum(run.time - 1.2345, 0.0)
        np.testing.assert_allclose(run.twist[:, 0], early + late / 1.5, rtol=1e-9)


def test_a_load_is_put_on_at_its_moment_before_any_command_comes():
    model = Model(Robot(mass=5.0), SMOOTH, (PayloadChange(5.0, 0.0, 1.0023),))
    run = drive(model, (2.0, 5.0, 5.0), until=3.0, every=0.5, max_step=0.3)
    heavy = Model(Robot(mass=10.0), SMOOTH)
    alike = drive(heavy, (2.0, 5.0, 5.0), until=3.0, every=0.5, max_step=0.3)
    np.testing.assert_allclose(run.twist, alike.twist, rtol=1e-12)


def test_friction_that_follows_the_weight_slows_down_as_before():
    rubbing = Friction('coulomb', normal_force=49.05, mu_coulomb=0.03)
    for share, slowing in ((0.0, 0.5), (1.0, 1.0)):
        model = Model(friction=rubbing, effects=(PayloadChange(10.0, 0.0, 2.0, share),))
        rows = (0.0, 6.0, 6.0), (1.0, 0.0, 0.0)
        speed = drive(model, *rows, until=3.0, every=0.25).twist[:, 0]
        before, after = speed[5] - speed[7], speed[9] - speed[11]
        np.testing.assert_allclose(after, slowing * before, rtol=1e-9)


def test_turning_changes_too():
    model = Model(friction=SMOOTH, effects=(PayloadChange(0.0, 0.4, 1.0),))
    run = push(model, 1.0, -1.0, 2.0, every=1.0)
    np.testing.assert_allclose(np.diff(run.twist[:, 1]), [1.0, 0.5], rtol=1e-9)


def test_live_robot_is_loaded_at_the_same_moment():
    model = Model(friction=SMOOTH, effects=(PayloadChange(5.0, 0.1, 0.505),))
    plant = Plant(model)
    for _ in range(100):
        plant.step(6.0, 4.0, 0.01)
    run = simulate(model, commands((0.0, 6.0, 4.0)), np.array([0.0, 1.0]))
    np.testing.assert_allclose(plant.twist, run.twist[-1], rtol=1e-9)


def test_load_taken_off_never_leaves_less_than_nothing():
    run = push(Model(effects=(PayloadChange(-50.0, -3.0, 0.5),)), 5.0, 4.0, 2.0)
    assert np.isfinite(run.pose).all()
    assert run.twist[-1, 0] > 0.0
