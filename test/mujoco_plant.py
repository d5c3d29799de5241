"""A differential drive in MuJoCo: a plant whose physics is not ours, to be identified."""

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.records import Array, Commands, Odometry, Run

GRAVITY = 9.80665
BEAT, EVERY = 0.01, 2  # commands change every beat [s], odometry comes every second one
FASTEST = (1.0, 2.2)  # terminal speeds that the drives aim at [m/s, rad/s]
SPHERE = 0.4  # of m r²: the wheels' moment of inertia


@dataclass(frozen=True)
class Rig:
    """The robot and its floor. Its frame is the middle of the axle.

    mass [kg] and inertia about the yaw axis through the frame [kg·m²] are those of the whole
    robot; coulomb [N] and viscous [N·s/m] are the friction of each wheel's bearing, seen at the
    rim; tilt [rad]: how steeply the floor rises towards world x; lag [s]: time constant of the
    motors; offset [m]: how far the chassis's centre of gravity lies ahead of the axle.
    """

    mass: float = 10.0
    inertia: float = 0.4
    wheel_separation: float = 0.4
    wheel_radius: float = 0.08
    wheel_mass: float = 0.8
    coulomb: float = 2.0
    viscous: float = 4.0
    tilt: float = 0.0
    lag: float = 0.0
    offset: float = 0.0

    def equivalent(self) -> Model:
        """Return our model of this robot on a level floor; spinning wheels add to its mass."""
        spin = SPHERE * self.wheel_mass
        half = self.wheel_separation / 2
        robot = Robot(
            self.mass + 2 * spin,
            self.inertia + 2 * spin * half**2,
            self.wheel_separation,
            self.wheel_radius,
        )
        load = self.mass * GRAVITY / 2
        return Model(
            robot, Friction('coulomb_viscous', load, 0.0, self.coulomb / load, self.viscous / load)
        )


def drive(
    rig: Rig,
    commands: Commands,
    noise: tuple[float, float] = (0.0, 0.0),
    seed: int = 0,
    name: str = 'mujoco',
    change: Callable[[mujoco.MjSpec], None] = lambda spec: None,
) -> Run:
    """Drive with wheel forces and measure at 50 Hz; the pose is true.

    commands: changes at whole multiples of BEAT, the first at 0.
    noise: standard deviations of the measured twist [m/s, rad/s].
    change: alters what the rig's description says.
    """
    spec = mujoco.MjSpec.from_string(mjcf(rig))
    change(spec)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    time = np.arange(round(commands.time[-1] / BEAT) + 1) * BEAT
    motion = np.empty((len(time), 5))
    for i, command in enumerate(np.searchsorted(commands.time, time + BEAT / 2) - 1):
        motion[i] = _measured(data)
        data.ctrl[:] = commands.force[command]
        mujoco.mj_step(model, data, round(BEAT / model.opt.timestep))
    return _run(name, commands, time[::EVERY], motion[::EVERY], noise, seed)


def _run(
    name: str,
    commands: Commands,
    time: Array,
    motion: Array,
    noise: tuple[float, float],
    seed: int,
) -> Run:
    twist = motion[:, :2] + np.random.default_rng(seed).normal(0.0, noise, (len(time), 2))
    pose = np.column_stack([motion[:, 2:4], np.unwrap(motion[:, 4])])
    return Run(name, commands, Odometry(time, twist, pose))


def excitation(seed: int, duration: float = 120.0, rig: Rig | None = None) -> Commands:
    """Return forces for forward, backward and turning drives, stops, and pushes that do nothing.

    The robot stands for the first second, as one does when a recording begins. Each force's
    terminal speed lies within FASTEST, so the robot's speed does as well.
    """
    rig, random = rig or Rig(), np.random.default_rng(seed)
    time = np.arange(round(duration / BEAT)) * BEAT
    force, begin, last = np.zeros((len(time), 2)), round(1.0 / BEAT), np.zeros(2)
    while begin < len(time):
        end = begin + round(random.uniform(0.5, 3.0) / BEAT)
        goal = _goal(rig, random)
        start = last if random.random() < 0.3 else goal
        span = force[begin:end]
        span[:] = start + (goal - start) * np.linspace(0.0, 1.0, len(span))[:, None]
        begin, last = end, goal
    return Commands(time, force)


def _goal(rig: Rig, random: np.random.Generator) -> Array:
    """Draw the forces that end a stretch: in 5 cases of 8 the robot shall move."""
    kind = random.choice(['arc', 'arc', 'arc', 'straight', 'turn', 'stop', 'stop', 'weak'])
    if kind == 'stop':
        return np.zeros(2)
    if kind == 'weak':
        return rig.coulomb * random.uniform(-1.3, 1.3, 2)
    v, omega = random.uniform(-1.0, 1.0, 2) * FASTEST
    speeds = {
        'arc': v + np.array([0.5, -0.5]) * rig.wheel_separation * omega,
        'straight': np.array([v, v]),
        'turn': np.array([0.5, -0.5]) * rig.wheel_separation * omega,
    }[kind]
    return np.asarray(rig.coulomb * np.sign(speeds) + rig.viscous * speeds)


def _measured(data: mujoco.MjData) -> tuple[float, ...]:
    """Return v and ω in the robot's frame, x, y and yaw."""
    ahead = data.body('chassis').xmat.reshape(3, 3)[:, 0]
    velocity, spin = data.qvel[:3], data.qvel[5]
    x, y, _ = data.qpos[:3]
    return float(ahead @ velocity), float(spin), x, y, float(np.arctan2(ahead[1], ahead[0]))


def mjcf(rig: Rig) -> str:
    """Describe the rig. Wheels touch in one point each, so turning scrubs nothing."""
    radius, half = rig.wheel_radius, rig.wheel_separation / 2
    wheel = SPHERE * rig.wheel_mass * radius**2
    chassis = rig.mass - 2 * rig.wheel_mass
    yaw = rig.inertia - 2 * (rig.wheel_mass * half**2 + wheel) - chassis * rig.offset**2
    motor = f'dyntype="filterexact" dynprm="{rig.lag}"' if rig.lag else ''
    return f"""
<mujoco>
  <option timestep="0.001" integrator="implicitfast" cone="elliptic" impratio="100"
          gravity="{-GRAVITY * np.sin(rig.tilt)} 0 {-GRAVITY * np.cos(rig.tilt)}"/>
  <default>
    <geom solref="0.002 1" solimp="0.99 0.999 0.0001"/>
    <default class="wheel">
      <geom type="sphere" size="{radius}" condim="3" friction="1 0 0"/>
      <joint axis="0 1 0" damping="{rig.viscous * radius**2}"
             frictionloss="{rig.coulomb * radius}"
             solreffriction="0.002 1" solimpfriction="0.999 0.9999 0.001"/>
    </default>
    <default class="caster">
      <geom type="sphere" size="0.02" condim="1"/>
    </default>
  </default>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1" condim="1"/>
    <body name="chassis" pos="0 0 {radius}">
      <freejoint/>
      <inertial pos="{rig.offset} 0 0" mass="{chassis}" diaginertia="{yaw} {yaw} {yaw}"/>
      <geom class="caster" pos="{0.8 * half} 0 {0.02 - radius}"/>
      <geom class="caster" pos="{-0.8 * half} 0 {0.02 - radius}"/>
      {_wheel('right', -half, rig.wheel_mass, wheel)}
      {_wheel('left', half, rig.wheel_mass, wheel)}
    </body>
  </worldbody>
  <actuator>
    <general joint="right" gear="{radius}" {motor}/>
    <general joint="left" gear="{radius}" {motor}/>
  </actuator>
</mujoco>"""


def _wheel(name: str, y: float, mass: float, inertia: float) -> str:
    return f"""
      <body pos="0 {y} 0">
        <joint name="{name}" class="wheel"/>
        <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>
        <geom class="wheel"/>
      </body>"""
