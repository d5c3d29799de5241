"""The same robot in MuJoCo, whose dry friction is a joint's frictionloss: Coulomb's law only."""

from functools import cache

import mujoco
import numpy as np
from mujoco import rollout

from diffbot_sim.physics import Model
from diffbot_sim.records import Array

# The stiffest friction that its solver takes: no softness, slip removed within one step.
STIFFEST = 'solreffriction="{span} 1" solimpfriction="0.9999 0.9999 0.001"'


def drive(stiff: bool, model: Model, forces: Array, interval: float, duration: float) -> Array:
    """Step from rest; return x, y and the wheels' travel [m] at every change of force.

    forces [N], shape (n, 2), each held for an interval [s] of steps of the given duration [s].
    """
    robot = _compiled(model, duration, stiff)
    count, full = round(interval / duration), mujoco.mjtState.mjSTATE_FULLPHYSICS
    states, _ = rollout.rollout(
        robot,
        mujoco.MjData(robot),
        np.zeros((1, mujoco.mj_stateSize(robot, full))),
        np.repeat(forces, count, axis=0)[None],
        control_spec=mujoco.mjtState.mjSTATE_QFRC_APPLIED,
    )
    travel = np.concatenate([np.zeros((1, 2)), states[0, :, 1:3]])  # behind the time
    return np.column_stack([_positions(model, travel), travel])[::count]


@cache
def _compiled(model: Model, duration: float, stiff: bool) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(mjcf(model, duration, stiff))


def _positions(model: Model, travel: Array) -> Array:
    """Return x, y: each step a chord of the arc that the wheels have rolled."""
    heading = (travel[:, 0] - travel[:, 1]) / (2.0 * model.robot.half_separation)
    middle = 0.5 * (heading[1:] + heading[:-1])
    along = np.column_stack([np.cos(middle), np.sin(middle)])
    chords = np.diff(travel.mean(axis=1))[:, None] * along
    return np.concatenate([np.zeros((1, 2)), np.cumsum(chords, axis=0)])


def mjcf(model: Model, duration: float, stiff: bool) -> str:
    """Describe two sliders, one carried by the other: their mass matrix is that of the wheels.

    The carried mass is what the wheels share, m/4 - J/(4 b²); J < m b².
    """
    mass, about = model.robot.mass, model.robot.inertia / model.robot.wheel_separation**2
    shared, law = mass / 4.0 - about, model.friction.law()
    solver = STIFFEST.format(span=2.0 * duration) if stiff else ''
    joint = (
        f'<joint type="slide" axis="1 0 0" damping="{law.viscous}" '
        f'frictionloss="{law.coulomb}" {solver}'
    )
    inertia = 'pos="0 0 0" diaginertia="1 1 1"'
    return f"""
<mujoco>
  <option timestep="{duration}" gravity="0 0 0"/>
  <worldbody>
    <body>
      {joint}/>
      <inertial mass="{2.0 * about}" {inertia}/>
      <body>
        {joint} armature="{2.0 * about}"/>
        <inertial mass="{shared}" {inertia}/>
      </body>
    </body>
  </worldbody>
</mujoco>"""
