"""The inner loop as a node: wanted motion and odometry in, wheel forces out."""

from functools import partial

from geometry_msgs.msg import Twist, TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node

from diffbot_sim.control.held import Held
from diffbot_sim.control.loop import InnerLoop
from diffbot_sim.control.pi import wheel_rates
from diffbot_sim.nodes import conversions
from diffbot_sim.nodes.company import watch_for_type
from diffbot_sim.nodes.outputs import DEPTH
from diffbot_sim.nodes.parameters import Live, build, table
from diffbot_sim.nodes.running import parse, parser, run
from diffbot_sim.nodes.sanity import accepts
from diffbot_sim.nodes.settings import ControllerSettings
from diffbot_sim.records import CONTACT_FRAMES, NANOSECONDS, SIDES, Pair

LONGEST = 0.1  # [s]; a gap in the odometry must not wind up the integral


class PiController(Node):
    """Answers each odometry message with two forces; knows no time but the odometry's.

    So it works in simulation time and at any speed of it.
    """

    def __init__(self) -> None:
        super().__init__('pi_controller')
        known = table(ControllerSettings)
        make = partial(build, ControllerSettings)
        live = Live(self, known, make, ControllerSettings.fixed, self._apply)
        self._settings = live.value
        self._loop = InnerLoop()
        self._stamp: int | None = None
        self._references = dict.fromkeys(SIDES, Held())
        self._unanswered: Odometry | None = None
        self._twist_stamp = 0
        self._connect()
        self.get_logger().info('ready')

    def _connect(self) -> None:
        command = TwistStamped if self._settings.enable_stamped_cmd_vel else Twist
        self._forces, self._wanted, self._measured = {}, {}, {}
        for side in SIDES:
            wheel, act = f'{side}_wheel', partial(self._on_wheel_reference, side)
            self._forces[side] = self.create_publisher(WrenchStamped, f'{wheel}/force_cmd', DEPTH)
            self._wanted[side] = self.create_publisher(
                TwistStamped, f'{wheel}/velocity_reference', DEPTH
            )
            self._measured[side] = self.create_publisher(TwistStamped, f'{wheel}/velocity', DEPTH)
            self.create_subscription(TwistStamped, f'{wheel}/velocity_cmd', act, DEPTH)
        self.create_subscription(command, 'cmd_vel', self._on_twist, DEPTH)
        other = 'false' if self._settings.enable_stamped_cmd_vel else 'true'
        watch_for_type(self, 'cmd_vel', command, f'start it with enable_stamped_cmd_vel:={other}')
        self.create_subscription(Odometry, 'odom', self._on_odometry, DEPTH)

    def _on_twist(self, message: Twist | TwistStamped) -> None:
        v, omega = conversions.twist_of(message)
        if accepts(self, 'cmd_vel', v, omega):
            rates = wheel_rates(v, omega, self._settings.robot)
            for side, rate in zip(SIDES, rates, strict=True):
                self._references[side] = Held(rate, self._stamp or 0)
            if isinstance(message, TwistStamped):
                self._twist_stamp = conversions.nanoseconds(message.header.stamp)
            self._answer()

    def _on_wheel_reference(self, side: str, message: TwistStamped) -> None:
        rate = conversions.wheel_rate_of(message)
        if accepts(self, f'{side}_wheel/velocity_cmd', rate):
            self._references[side] = Held(rate, self._stamp or 0)

    def _on_odometry(self, message: Odometry) -> None:
        if accepts(self, 'odom', *conversions.twist_of(message)):
            self._unanswered = message
            self._answer()

    def _answer(self) -> None:
        """Answer the last odometry; in lockstep only when the twist of its stamp has come."""
        message = self._unanswered
        if message is None:
            return
        stamp = conversions.nanoseconds(message.header.stamp)
        if self._settings.lockstep and self._twist_stamp != stamp:
            return
        self._unanswered = None
        dt = self._advance(stamp)
        measured = wheel_rates(*conversions.twist_of(message), self._settings.robot)
        output = self._loop.step(self._settings, self._wanted_rates(stamp), measured, dt)
        self._publish(message, output.force, output.reference, measured)

    def _advance(self, stamp: int) -> float:
        """Return the time [s] since the last odometry; begin anew where time jumps back."""
        last, self._stamp = self._stamp, stamp
        if last is not None and stamp >= last:
            return min((stamp - last) / NANOSECONDS, LONGEST)
        self._loop.reset()
        timeout = self._settings.cmd_vel_timeout
        for side, held in self._references.items():
            # What had run out before the jump stays so.
            value = held.value if last is None else held.at(last, timeout)
            self._references[side] = Held(value, stamp)
        return 0.0

    def _wanted_rates(self, stamp: int) -> Pair:
        timeout = self._settings.cmd_vel_timeout
        right, left = (self._references[side].at(stamp, timeout) for side in SIDES)
        return right, left

    def _publish(self, about: Odometry, force: Pair, reference: Pair, measured: Pair) -> None:
        stamp = conversions.nanoseconds(about.header.stamp)
        prefix = conversions.frame_prefix_of(about)
        for side, *values in zip(SIDES, force, reference, measured, strict=True):
            frame = prefix + CONTACT_FRAMES[side]
            self._forces[side].publish(conversions.wrench(stamp, frame, values[0]))
            self._wanted[side].publish(conversions.wheel_rate(stamp, frame, values[1]))
            self._measured[side].publish(conversions.wheel_rate(stamp, frame, values[2]))

    def _apply(self, settings: ControllerSettings) -> None:
        self._settings = settings


def main(argv: list[str]) -> int:
    """Run the node until it is told to stop."""
    about = 'Hold the wheels at the wanted speeds: cmd_vel and odometry in, wheel forces out.'
    parse(parser('pi_controller', about, table(ControllerSettings)), argv)
    return run(PiController, argv)
