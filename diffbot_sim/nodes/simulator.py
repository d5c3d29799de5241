"""The simulated robot as a node: wheel forces in, odometry out."""

from functools import partial
from math import isfinite
from time import monotonic
from typing import NamedTuple

from geometry_msgs.msg import WrenchStamped
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Empty, SetBool

from diffbot_sim.control.held import NANOSECONDS, Held
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.odometer import Odometer
from diffbot_sim.nodes.outputs import DEPTH, SIDES, Outputs
from diffbot_sim.nodes.pace import Pace
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
from diffbot_sim.nodes.settings import SimulatorSettings
from diffbot_sim.physics import Model, Plant

SHORTEST_TIMER = 1e-3  # [s]; the executor cannot wake more often to any use
QUIET = 5.0  # [s] between repeated warnings


class Setup(NamedTuple):
    """All that parameters decide."""

    settings: SimulatorSettings
    model: Model


class Simulator(Node):
    """Ticks on a steady clock: takes the commands, publishes state and forces, moves on.

    All messages of a tick carry its stamp, and the forces published are those held until
    the next tick, so a recording of forces and odometry replays exactly.
    """

    def __init__(self) -> None:
        super().__init__('simulator')
        known = table(SimulatorSettings) | model_table()
        self._listed = listed_effects(self)
        live = Live(self, known, self._make, self._apply, SimulatorSettings.fixed)
        self._settings, model = live.value
        self._plant = Plant(model, self._settings.physics_step)  # compiles before anyone waits
        self._start = 0 if self._settings.publish_clock else self.get_clock().now().nanoseconds
        self._ticks = 0
        self._paused = False
        self._commands = dict.fromkeys(SIDES, Held())
        self._odometer = self._new_odometer()
        self._connect()
        self._start_ticking()
        effects = ', '.join(effect.name for effect in model.effects) or 'no effects'
        self.get_logger().info(f'ready: {self._settings.publish_rate:g} Hz, {effects}')

    @property
    def stamp(self) -> int:
        """Simulation time of the next tick [ns]; ticks are exactly 1/rate apart."""
        return self._start + round(self._ticks * NANOSECONDS / self._settings.publish_rate)

    def _connect(self) -> None:
        self._outputs = Outputs(self, self._settings.publish_clock, self._settings.enable_odom_tf)
        for side in SIDES:
            topic, act = f'{side}_wheel/force_cmd', partial(self._on_command, side)
            self.create_subscription(WrenchStamped, topic, act, DEPTH)
        self.create_service(Empty, '~/reset', self._on_reset)
        self.create_service(SetBool, '~/pause', self._on_pause)
        self._timer = self.create_timer(
            1.0, self._on_timer, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def _start_ticking(self) -> None:
        period = 1.0 / (self._settings.publish_rate * self._settings.real_time_factor)
        self._pace = Pace(period, monotonic())
        self._timer.timer_period_ns = int(max(period, SHORTEST_TIMER) * NANOSECONDS)
        self._timer.reset()

    def _on_timer(self) -> None:
        if self._paused:
            return
        due, given_up = self._pace.due(monotonic())
        for _ in range(due):
            self._tick()
        if given_up:
            self.get_logger().warning(
                f'too slow: {given_up} ticks late; simulation time falls behind',
                throttle_duration_sec=QUIET,
            )

    def _tick(self) -> None:
        stamp = self.stamp
        force = (self._taken('right', stamp), self._taken('left', stamp))
        self._plant.command(*force)
        self._outputs.publish(stamp, self._plant, force, self._odometer)
        self._ticks += 1
        self._plant.step(*force, (self.stamp - stamp) / NANOSECONDS)

    def _taken(self, side: str, stamp: int) -> float:
        command, timeout = self._commands[side], self._settings.force_timeout
        if command.value and command.is_stale(stamp, timeout):
            self.get_logger().warning(
                f'no {side}_wheel/force_cmd for {timeout:g} s: its force falls to zero',
                throttle_duration_sec=QUIET,
            )
            self._commands[side] = Held()  # said once, not for ever
        return command.at(stamp, timeout)

    def _on_command(self, side: str, message: WrenchStamped) -> None:
        force = conversions.force_of(message)
        if isfinite(force):
            self._commands[side] = Held(force, self.stamp)
        else:
            self.get_logger().warning(
                f'{side}_wheel/force_cmd: {force} is no force; refused',
                throttle_duration_sec=QUIET,
            )

    def _on_reset(self, _: Empty.Request, answer: Empty.Response) -> Empty.Response:
        """Put the robot at rest at the origin; stamps go on, for nobody likes time to jump."""
        self._plant.reset()
        self._commands = dict.fromkeys(SIDES, Held())
        self._odometer = self._new_odometer()
        return answer

    def _on_pause(self, ask: SetBool.Request, answer: SetBool.Response) -> SetBool.Response:
        self._paused = ask.data
        self._start_ticking()
        answer.success, answer.message = True, 'paused' if ask.data else 'running'
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
            self._start_ticking()
        if setup.settings.odometry_noise != before.odometry_noise:
            self._odometer = self._new_odometer()


def main(argv: list[str]) -> int:
    """Run the node until it is told to stop."""
    known = table(SimulatorSettings) | model_table()
    parse(parser('simulator', 'Simulate the robot: wheel forces in, odometry out.', known), argv)
    return run(Simulator, argv)
