"""The simulated robot as a node: wheel forces in, odometry out."""

from functools import partial
from typing import NamedTuple

from geometry_msgs.msg import PoseWithCovarianceStamped, WrenchStamped
from rclpy.node import Node
from std_srvs.srv import Empty, SetBool, Trigger

from diffbot_sim.control.held import Held
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.company import watch_for_doubles
from diffbot_sim.nodes.odometer import Odometer
from diffbot_sim.nodes.outputs import DEPTH, Outputs
from diffbot_sim.nodes.parameters import (
    Live,
    Values,
    build,
    build_model,
    listed_effects,
    model_table,
    table,
)
from diffbot_sim.nodes.running import parse, parser, run
from diffbot_sim.nodes.sanity import accepts, are_sane
from diffbot_sim.nodes.settings import SimulatorSettings
from diffbot_sim.nodes.timing import QUIET, Lockstep, OnClock
from diffbot_sim.physics import Model, Plant
from diffbot_sim.physics.state import State
from diffbot_sim.records import NANOSECONDS, SIDES


class Setup(NamedTuple):
    """All that parameters decide."""

    settings: SimulatorSettings
    model: Model


class Simulator(Node):
    """At each tick takes the commands, publishes state and forces, and moves on.

    All messages of a tick carry its stamp, and the forces published are those held until
    the next tick, so a recording of forces and odometry replays exactly.
    """

    def __init__(self) -> None:
        super().__init__('simulator')
        known = table(SimulatorSettings) | model_table()
        self._listed = listed_effects(self)
        live = Live(self, known, self._make, SimulatorSettings.fixed, self._apply)
        self._settings, model = live.value
        # Compiles before anyone waits.
        self._plant = Plant(model, self._settings.physics_step, self._home)
        self._start = self._first_stamp()
        self._ticks = 0
        self._paused = False
        self._commands = dict.fromkeys(SIDES, Held())
        self._odometer = self._new_odometer()
        self._connect()
        self._time = self._timing()
        self._go()
        effects = ', '.join(effect.name for effect in model.effects) or 'no effects'
        self.get_logger().info(f'ready: {self._settings.publish_rate:g} Hz, {effects}')

    @property
    def stamp(self) -> int:
        """Simulation time of the present tick [ns]; ticks are exactly 1/rate apart."""
        return self._stamp_of(self._ticks)

    @property
    def _home(self) -> State:
        return State(*self._settings.initial_pose.xy_yaw)

    def _first_stamp(self) -> int:
        if self._settings.lockstep:  # a stamp of 0 means none, so the first is that of a tick
            return round(NANOSECONDS / self._settings.publish_rate)
        return 0 if self._settings.publish_clock else self.get_clock().now().nanoseconds

    def _stamp_of(self, tick: int) -> int:
        return self._start + round(tick * NANOSECONDS / self._settings.publish_rate)

    def _connect(self) -> None:
        self._outputs = Outputs(self, self._settings)
        watch_for_doubles(self, 'odom')
        for side in SIDES:
            topic, act = f'{side}_wheel/force_cmd', partial(self._on_command, side)
            self.create_subscription(WrenchStamped, topic, act, DEPTH)
        self.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._on_initial_pose, DEPTH
        )
        self.create_service(Empty, '~/reset', self._on_reset)
        self.create_service(SetBool, '~/pause', self._on_pause)
        self.create_service(Trigger, '~/step', self._on_step)

    def _timing(self) -> OnClock | Lockstep:
        if self._settings.lockstep:
            return Lockstep(self, self._show, self._outputs.repeat, self._advance)
        return OnClock(self, self._show, self._advance)

    def _go(self) -> None:
        if self._paused:
            self._time.stop()
            return
        factor = self._settings.real_time_factor
        self._time.start(1.0 / (self._settings.publish_rate * factor) if factor else 0.0)

    def _show(self) -> None:
        """Publish the state of the present tick."""
        self._outputs.publish_motion(self.stamp, self._plant, self._odometer)

    def _advance(self) -> None:
        """Take the commands, publish what they meet, and hold them until the next tick."""
        stamp = self.stamp
        self._drop_stale(stamp)
        force = (self._commands['right'].value, self._commands['left'].value)
        self._plant.command(*force)
        self._outputs.publish_forces(stamp, self._plant, force)
        self._ticks += 1
        self._plant.step(*force, (self.stamp - stamp) / NANOSECONDS)

    def _drop_stale(self, stamp: int) -> None:
        """Let forces that are too old fall to zero, and say so once."""
        timeout, commands = self._settings.force_timeout, self._commands.items()
        stale = [side for side, held in commands if held.value and held.is_stale(stamp, timeout)]
        if stale:
            topics = ' and '.join(f'{side}_wheel/force_cmd' for side in stale)
            self.get_logger().warning(
                f'no {topics} for {timeout:g} s: no force', throttle_duration_sec=QUIET
            )
            self._commands |= dict.fromkeys(stale, Held())

    def _on_command(self, side: str, message: WrenchStamped) -> None:
        force = conversions.force_of(message)
        if accepts(self, f'{side}_wheel/force_cmd', force) and not self._is_late(message):
            self._commands[side] = Held(force, self.stamp)
            self._time.heard(side)

    def _is_late(self, message: WrenchStamped) -> bool:
        """Say whether a command answers an earlier tick, which had been answered already.

        Asked in lockstep only, where a tick may be told, and so answered, twice.
        """
        stamp = conversions.nanoseconds(message.header.stamp)
        tick = round((stamp - self._start) * self._settings.publish_rate / NANOSECONDS)
        known = 0 <= tick < self._ticks and stamp == self._stamp_of(tick)
        return self._settings.lockstep and known

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        """Put the robot somewhere else, at rest."""
        pose, frame = conversions.pose_of(message), message.header.frame_id
        if frame in ('', self._outputs.world) and are_sane(pose):
            self._plant.place(State(*pose))
            self._begin_anew()
        else:
            self.get_logger().warning(
                f"initialpose: {pose} in '{frame}' is refused; give a finite pose in "
                f"'{self._outputs.world}'"
            )

    def _on_reset(self, _: Empty.Request, answer: Empty.Response) -> Empty.Response:
        """Put the robot at rest where it started; stamps go on: nobody likes time to jump."""
        self._plant.reset(self._home)
        self._odometer = self._new_odometer()
        self._begin_anew()
        return answer

    def _begin_anew(self) -> None:
        """Forget what was commanded; in lockstep, so that answers on their way come too late."""
        self._commands = dict.fromkeys(SIDES, Held())
        if self._settings.lockstep:
            self._ticks += 1
        self._time.restart()

    def _on_pause(self, ask: SetBool.Request, answer: SetBool.Response) -> SetBool.Response:
        self._paused = ask.data
        self._go()
        answer.success, answer.message = True, 'paused' if ask.data else 'running'
        return answer

    def _on_step(self, _: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        """Make one tick of a paused robot."""
        if self._paused:
            self._time.step()
        answer.success = self._paused
        answer.message = f'at {self.stamp} ns' if self._paused else 'not paused: ~/pause first'
        return answer

    def _new_odometer(self) -> Odometer:
        return Odometer(self._settings.odometry_noise, self._settings.covariance_floor)

    def _make(self, values: Values) -> Setup:
        return Setup(build(SimulatorSettings, values), build_model(values, self._listed))

    def _apply(self, setup: Setup) -> None:
        """Change what changed, and leave the rest as it moves."""
        before, self._settings = self._settings, setup.settings
        changed = setup.model != self._plant.model
        if changed:
            self._plant.model = setup.model  # compiles a set of effects that is new
        if changed or setup.settings.real_time_factor != before.real_time_factor:
            self._go()
        if setup.settings.odometry_noise != before.odometry_noise:
            self._odometer = self._new_odometer()


def main(argv: list[str]) -> int:
    """Run the node until it is told to stop."""
    known = table(SimulatorSettings) | model_table()
    parse(parser('simulator', 'Simulate the robot: wheel forces in, odometry out.', known), argv)
    return run(Simulator, argv)
