"""Start the simulator and its inner loop; record:=true adds a recorder, rviz:=true a view."""

from pathlib import Path
from typing import Any

from launch.actions import (
    DeclareLaunchArgument,
    IncludeLaunchDescription,
    OpaqueFunction,
    Shutdown,
)
from launch.events.process import ProcessExited
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchContext, LaunchDescription

PACKAGE = 'diffbot_sim'
PARAMS = PathJoinSubstitution([FindPackageShare(PACKAGE), 'config', 'diffbot.yaml'])
VIEW = PythonLaunchDescriptionSource(str(Path(__file__).with_name('view_launch.py')))
TRUE_OR_FALSE = ['true', 'false']
# Each is the parameter of that name; one that is empty leaves the word to the parameter file.
NUMBERS = {
    'real_time_factor': 'simulation time over wall time',
    'initial_pose.x': 'where the robot starts [m]',
    'initial_pose.y': 'where the robot starts [m]',
    'initial_pose.yaw': 'where the robot faces [rad]',
}
TRUTHS = {
    'enable_stamped_cmd_vel': 'cmd_vel is a TwistStamped',
    'enable_odom_tf': 'publish tf from odom to base_link; empty: if something shows the robot',
}
POSE = [name for name in NUMBERS if name.startswith('initial_pose')]


def generate_launch_description() -> LaunchDescription:
    """Declare the arguments beside those of view_launch.py, which is included."""
    return LaunchDescription(
        [
            DeclareLaunchArgument('params', default_value=PARAMS, description='parameter file'),
            *(
                DeclareLaunchArgument(name, default_value='', description=meaning)
                for name, meaning in NUMBERS.items()
            ),
            *(
                DeclareLaunchArgument(
                    name, default_value='', choices=['', *TRUE_OR_FALSE], description=meaning
                )
                for name, meaning in TRUTHS.items()
            ),
            DeclareLaunchArgument(
                'record', default_value='false', choices=TRUE_OR_FALSE, description='record a bag'
            ),
            DeclareLaunchArgument(
                'output', default_value='', description='folder of the bag; empty: date and time'
            ),
            IncludeLaunchDescription(VIEW),
            OpaqueFunction(function=_nodes),
        ]
    )


def _nodes(context: LaunchContext) -> list[Node]:
    given = context.launch_configurations
    # ROS would only warn, and simulate a robot that nobody asked for.
    if not Path(given['params']).is_file():
        raise FileNotFoundError(f'params: {given["params"]}: there is no such file')
    own = ['real_time_factor', 'enable_odom_tf', 'frame_prefix', *POSE]
    nodes = [
        _node('simulator', given, own, 'publish_clock'),
        _node('pi_controller', given, ['enable_stamped_cmd_vel']),
    ]
    if given['record'] == 'true':
        nodes.append(_node('recorder', given, ['output']))
    return nodes


def _node(
    name: str, given: dict[str, str], arguments: list[str], clock: str = 'use_sim_time'
) -> Node:
    values = {key: _value(key, given[key]) for key in arguments if given[key]}
    if given['use_sim_time'] == 'true':
        values[clock] = True
    return Node(
        package=PACKAGE,
        executable=name,
        namespace=given['namespace'],
        # ROS cannot read a file without parameters, so none is made of an empty mapping.
        parameters=[given['params'], *([values] if values else [])],
        # Frames with a prefix are told apart, so that robots may share one tf.
        remappings=[('tf', '/tf')] if given['frame_prefix'] else [],
        on_exit=_end,
        sigkill_timeout='20',  # a recorder on a busy machine must get its bag closed
        output='screen',
    )


def _value(name: str, text: str) -> Any:
    """Read an argument, which is text, as ROS wants it: a number, a truth or a text."""
    if name in TRUTHS:
        return text == 'true'
    if name not in NUMBERS:
        return text
    try:
        return float(text)
    except ValueError:
        raise ValueError(f'{name}: {text!r} is no number; give one such as 2.0') from None


def _end(event: ProcessExited, context: LaunchContext) -> Shutdown | None:
    """Let no robot drive on without one of its parts, and tell the shell if one has failed."""
    if context.is_shutdown:
        return None
    if event.returncode:  # only an exception makes launch end with another code than 0
        raise RuntimeError(f'{event.process_name} ended with exit code {event.returncode}')
    return Shutdown(reason='a node has ended')
