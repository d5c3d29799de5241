"""Start the simulator and its inner loop, and with record:=true a recorder."""

from pathlib import Path

from launch.actions import DeclareLaunchArgument, OpaqueFunction, Shutdown
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from launch import Event, LaunchContext, LaunchDescription

PACKAGE = 'diffbot_sim'
PARAMS = PathJoinSubstitution([FindPackageShare(PACKAGE), 'config', 'diffbot.yaml'])
TRUE_OR_FALSE = ['true', 'false']
# Arguments are texts; ROS refuses a text where it wants a number or a truth.
TYPES = {'real_time_factor': float, 'enable_stamped_cmd_vel': bool, 'output': str}


def generate_launch_description() -> LaunchDescription:
    """Declare the arguments; one that is empty leaves the word to the parameter file."""
    return LaunchDescription(
        [
            DeclareLaunchArgument('params', default_value=PARAMS, description='parameter file'),
            DeclareLaunchArgument('namespace', default_value='', description='of all nodes'),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=TRUE_OR_FALSE,
                description='publish /clock from 0 on, and let the other nodes follow it',
            ),
            DeclareLaunchArgument(
                'real_time_factor', default_value='', description='simulation time over wall time'
            ),
            DeclareLaunchArgument(
                'enable_stamped_cmd_vel', default_value='', description='cmd_vel is a TwistStamped'
            ),
            DeclareLaunchArgument(
                'record', default_value='false', choices=TRUE_OR_FALSE, description='record a bag'
            ),
            DeclareLaunchArgument(
                'output', default_value='', description='folder of the bag; empty: date and time'
            ),
            OpaqueFunction(function=_nodes),
        ]
    )


def _nodes(context: LaunchContext) -> list[Node]:
    def argument(name: str) -> str:
        return LaunchConfiguration(name).perform(context)

    def node(name: str, clock: str, *arguments: str) -> Node:
        values = {
            key: ParameterValue(LaunchConfiguration(key), value_type=TYPES[key])
            for key in arguments
            if argument(key)
        }
        if argument('use_sim_time') == 'true':
            values[clock] = True
        return Node(
            package=PACKAGE,
            on_exit=_end,
            executable=name,
            namespace=argument('namespace'),
            # ROS cannot read a file without parameters, so none is made of an empty mapping.
            parameters=[argument('params'), *([values] if values else [])],
            output='screen',
        )

    # ROS would only warn, and simulate a robot that nobody asked for.
    if not Path(argument('params')).is_file():
        raise FileNotFoundError(f'params: {argument("params")}: there is no such file')
    factor = argument('real_time_factor')
    if factor and not _is_number(factor):
        raise ValueError(f'real_time_factor: {factor!r} is no number; give one such as 2.0')
    nodes = [
        node('simulator', 'publish_clock', 'real_time_factor'),
        node('pi_controller', 'use_sim_time', 'enable_stamped_cmd_vel'),
    ]
    if argument('record') == 'true':
        nodes.append(node('recorder', 'use_sim_time', 'output'))
    return nodes


def _is_number(text: str) -> bool:
    try:
        return float(text) > 0.0
    except ValueError:
        return False


def _end(_: Event, context: LaunchContext) -> Shutdown | None:
    """Let no robot drive on without one of its parts."""
    return None if context.is_shutdown else Shutdown(reason='a node has ended')
