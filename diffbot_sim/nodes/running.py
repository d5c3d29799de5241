"""Runs one node from its command line to a clean end."""

import signal
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node
from rclpy.parameter import Parameter

from diffbot_sim.errors import ConfigError
from diffbot_sim.nodes.parameters import table
from diffbot_sim.nodes.timing import steady_clock
from diffbot_sim.parameters import Spec

LOOK_UP = 0.2  # [s] that an idle node may sleep after a signal


def parser(name: str, about: str, known: dict[str, Spec]) -> ArgumentParser:
    """Return the parser of a node's own options; its help lists the ROS parameters."""
    lines = [f'  {key} = {spec.default}   {spec.meaning}' for key, spec in known.items()]
    return ArgumentParser(
        prog=f'diffbot_sim {name}',
        description=about,
        epilog='\n'.join(['ROS parameters (--ros-args -p NAME:=VALUE):', *lines]) if lines else '',
        formatter_class=RawDescriptionHelpFormatter,
    )


def parse(options: ArgumentParser, argv: list[str]) -> Namespace:
    """Read a node's own options, which stand beside those between --ros-args and --."""
    own, is_ros = [], False
    for word in argv:
        is_ros = (is_ros and word != '--') or word == '--ros-args'
        if not is_ros and word != '--':
            own.append(word)
    return options.parse_args(own)


def overrides(kind: Any, options: Namespace) -> list[Parameter]:
    """Return the options that were given as parameters of the same name: they beat files."""
    chosen = {name: value for name, value in vars(options).items() if value is not None}
    return [Parameter(name, value=chosen[name]) for name in table(kind) if name in chosen]


def run(
    make: Callable[[], Node], argv: list[str], work: Callable[[Any], None] = rclpy.spin
) -> int:
    """Make a node, let it work until SIGINT or SIGTERM, close it; return the exit code 0.

    Raises DiffbotError where something known is wrong, after everything is closed.
    """
    node = None
    # Ctrl-C ends the ROS context, as SIGTERM does, and that ends the work between two callbacks.
    # KeyboardInterrupt would cut through compiled code and half-written messages.
    interrupts: list[int] = []
    signal.signal(signal.SIGINT, lambda number, frame: interrupts.append(number))
    try:
        _initialise(argv)
        if interrupts:  # too early for ROS to hear it
            raise ExternalShutdownException
        node = make()
        # rclpy may wake an idle node for a signal before the context has ended: wake it again.
        node.create_timer(LOOK_UP, lambda: None, clock=steady_clock())
        work(node)
    except ExternalShutdownException:
        pass
    except ParameterException as error:  # of the parameters that rclpy itself declares
        raise ConfigError(f'ROS parameters: {error}') from error
    except rclpy_implementation.RCLError:
        if rclpy.ok():  # else a signal ended the context while a message was on its way
            raise
    finally:
        _close(node)
    return 0


def _initialise(argv: list[str]) -> None:
    """Start ROS; raises ConfigError where its arguments or parameter files are wrong."""
    # It tells of faults in the arguments on its own, in a line that says nothing.
    set_logger_level('rcl', LoggingSeverity.FATAL)
    try:
        rclpy.init(args=['', *argv])
    except (rclpy_implementation.RCLError, rclpy_implementation.UnknownROSArgsError) as error:
        text = ' '.join(str(error).split()).removeprefix('failed to initialize rcl: ')
        raise ConfigError(f'ROS arguments: {text.partition(", at /")[0]}') from error
    set_logger_level('rcl', LoggingSeverity.UNSET)


def _close(node: Node | None) -> None:
    # A second Ctrl-C must not cut off what the node still has to write.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    if node is not None:
        node.destroy_node()  # a node that has something to finish does it here
    rclpy.try_shutdown()
