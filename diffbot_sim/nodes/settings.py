"""The parameters of each node, beside those of the model."""

from dataclasses import dataclass, field
from typing import ClassVar

from diffbot_sim.control.loop import LoopSettings
from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import parameter

STORAGES = ('mcap', 'sqlite3')


@dataclass(frozen=True)
class OdometryNoise:
    """White noise on the measured twist; the same seed gives the same noise."""

    linear: float = parameter(
        0.0, unit='m/s', low=0.0, high=100.0, meaning='standard deviation of the noise on v'
    )
    angular: float = parameter(
        0.0, unit='rad/s', low=0.0, high=100.0, meaning='standard deviation of the noise on ω'
    )
    seed: int = parameter(0, low=0, high=2**31 - 1, meaning='seed of the noise')


@dataclass(frozen=True)
class InitialPose:
    """Where the robot stands at the start and after a reset, at rest."""

    x: float = parameter(0.0, unit='m', low=-1e6, high=1e6, meaning='place along the world x axis')
    y: float = parameter(0.0, unit='m', low=-1e6, high=1e6, meaning='place along the world y axis')
    yaw: float = parameter(0.0, unit='rad', low=-1e3, high=1e3, meaning='heading')

    @property
    def xy_yaw(self) -> tuple[float, float, float]:
        """All three [m, m, rad]."""
        return self.x, self.y, self.yaw


@dataclass(frozen=True)
class SimulatorSettings:
    """Rates, clock and sensors of the simulator. `fixed` ones cannot change while it runs."""

    fixed: ClassVar[tuple[str, ...]] = (
        'publish_rate',
        'physics_step',
        'publish_clock',
        'lockstep',
        'covariance_floor',
        'enable_odom_tf',
        'frame_prefix',
        'initial_pose.x',
        'initial_pose.y',
        'initial_pose.yaw',
    )

    publish_rate: float = parameter(
        100.0, unit='Hz', low=0.1, high=1e4, meaning='ticks in a second of simulation time'
    )
    physics_step: float = parameter(
        1e-3, unit='s', low=1e-6, high=0.1, meaning='longest step of the integrator'
    )
    real_time_factor: float = parameter(
        1.0,
        low=0.0,
        high=1e6,
        meaning='simulation time over wall time; 0 = as fast as the machine can',
    )
    publish_clock: bool = parameter(
        False, meaning='publish /clock; simulation time then starts at 0'
    )
    lockstep: bool = parameter(
        False,
        meaning='time waits until both wheels are commanded; the first stamp is one tick, not 0',
    )
    force_timeout: float = parameter(
        0.5,
        unit='s',
        low=0.0,
        high=1e6,
        meaning='a force command older than this falls to zero, in simulation time; 0 = never',
    )
    covariance_floor: float = parameter(
        1e-9,
        low=1e-12,
        high=1e6,
        meaning='least variance on the diagonals of the odometry covariances, in SI units',
    )
    enable_odom_tf: bool = parameter(False, meaning='publish tf from odom to base_link')
    frame_prefix: str = parameter('', meaning='put before every frame name, such as robot1/')
    initial_pose: InitialPose = field(default=InitialPose())
    odometry_noise: OdometryNoise = field(default=OdometryNoise())


@dataclass(frozen=True)
class ControllerSettings(LoopSettings):
    """The inner loop and where its references come from."""

    fixed: ClassVar[tuple[str, ...]] = ('enable_stamped_cmd_vel', 'lockstep')

    cmd_vel_timeout: float = parameter(
        0.5,
        unit='s',
        low=0.0,
        high=1e6,
        meaning='a reference older than this falls to zero, in time of the odometry; 0 = never',
    )
    enable_stamped_cmd_vel: bool = parameter(False, meaning='cmd_vel is a TwistStamped')
    lockstep: bool = parameter(
        False, meaning='wait with each answer for the cmd_vel that has the stamp of the odometry'
    )

    def __post_init__(self) -> None:
        if self.lockstep and not self.enable_stamped_cmd_vel:
            raise ConfigError(
                'lockstep: an unstamped cmd_vel does not say which odometry it answers. '
                'Set enable_stamped_cmd_vel to true, too.'
            )


@dataclass(frozen=True)
class RecorderSettings:
    """What is recorded, and where to."""

    output: str = parameter('', meaning='folder of the new bag; empty names it by date and time')
    topics: tuple[str, ...] = parameter(
        (
            'left_wheel/force',
            'right_wheel/force',
            'left_wheel/force_cmd',
            'right_wheel/force_cmd',
            'left_wheel/friction',
            'right_wheel/friction',
            'odom',
            'joint_states',
            'cmd_vel',
            'left_wheel/velocity_reference',
            'right_wheel/velocity_reference',
            'left_wheel/velocity',
            'right_wheel/velocity',
        ),
        meaning='topics to record',
    )
    storage: str = parameter(STORAGES[0], choices=STORAGES, meaning='kind of file')
    max_bag_size: int = parameter(
        0,
        unit='bytes',
        low=0,
        high=2**63 - 1,
        meaning='a file so big is followed by another; 0 = never',
    )
    max_bag_duration: float = parameter(
        0.0,
        unit='s',
        low=0.0,
        high=1e9,
        meaning='a file so long is followed by another; 0 = never',
    )


@dataclass(frozen=True)
class DriverSettings:
    """How long and how fast to drive. Mind the room: the drive turns, but does not look."""

    duration: float = parameter(
        120.0, unit='s', low=1.0, high=1e5, meaning='length of the drive, in time of the odometry'
    )
    fastest: float = parameter(0.8, unit='m/s', low=0.0, high=100.0, meaning='largest speed')
    fastest_turn: float = parameter(
        2.0, unit='rad/s', low=0.0, high=100.0, meaning='largest yaw rate'
    )
    seed: int = parameter(0, low=0, high=2**31 - 1, meaning='seed of the drive')
    stamped: bool = parameter(
        False, meaning='publish a TwistStamped with the stamp of the odometry it answers'
    )


# One file may hold the parameters of all nodes, so each node knows the names of the others.
ALL = (SimulatorSettings, ControllerSettings, RecorderSettings, DriverSettings)
