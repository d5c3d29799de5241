"""Show a robot: its description and tf, where that package is installed, and RViz if asked for.

Bringup includes it; alone it shows a robot that runs elsewhere, or a bag that is replayed.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
)
from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction, SetLaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import Action, LaunchContext, LaunchDescription

SHARE = Path(get_package_share_directory('diffbot_sim'))
TRUE_OR_FALSE = ['true', 'false']
SKIPPED = (
    'robot_state_publisher is not installed: no robot_description, no tf of the wheels. '
    'Install it (ros-$ROS_DISTRO-robot-state-publisher), or say description:=false'
)
NO_RVIZ = (
    'rviz: the package rviz2 is not installed; install it (ros-$ROS_DISTRO-rviz2), '
    'or leave rviz:=true away'
)


def generate_launch_description() -> LaunchDescription:
    """Declare the arguments; bringup leaves them to this file."""
    return LaunchDescription(
        [
            DeclareLaunchArgument('namespace', default_value='', description='of all nodes'),
            DeclareLaunchArgument(
                'frame_prefix',
                default_value='',
                description='before every frame, such as robot1/; such frames share /tf',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=TRUE_OR_FALSE,
                description='simulator publishes /clock from 0 on, the other nodes follow it',
            ),
            DeclareLaunchArgument(
                'description',
                default_value='true',
                choices=TRUE_OR_FALSE,
                description='publish the robot description and the tf of its parts',
            ),
            DeclareLaunchArgument(
                'rviz', default_value='false', choices=TRUE_OR_FALSE, description='open RViz'
            ),
            DeclareLaunchArgument(
                'rviz_config',
                default_value=str(SHARE / 'config' / 'diffbot.rviz'),
                description='what RViz shows; the default fits any namespace, but no frame_prefix',
            ),
            OpaqueFunction(function=_view),
        ]
    )


def _view(context: LaunchContext) -> list[Action]:
    given = context.launch_configurations
    actions: list[Action] = []
    if given['description'] == 'true':
        found = _is_installed('robot_state_publisher')
        actions.append(_description(given) if found else LogInfo(msg=SKIPPED))
    if given['rviz'] == 'true':
        if not _is_installed('rviz2'):
            raise ValueError(NO_RVIZ)
        actions.append(_node('rviz2', given, arguments=['-d', given['rviz_config']]))
    # Both want to know where the robot is.
    if any(isinstance(action, Node) for action in actions) and not given.get('enable_odom_tf'):
        actions.append(SetLaunchConfiguration('enable_odom_tf', 'true'))
    return actions


def _is_installed(package: str) -> bool:
    try:
        get_package_prefix(package)
    except PackageNotFoundError:
        return False
    return True


def _description(given: dict[str, str]) -> Node:
    text = (SHARE / 'urdf' / 'diffbot.urdf').read_text()
    own = {
        'robot_description': ParameterValue(text, value_type=str),
        'frame_prefix': given['frame_prefix'],
    }
    return _node('robot_state_publisher', given, parameters=[own])


def _node(
    package: str,
    given: dict[str, str],
    parameters: Sequence[dict[str, Any]] = (),
    arguments: Sequence[str] = (),
) -> Node:
    """Make the node that has its package's name; frames without a prefix stay in its namespace."""
    own_tf = [] if given['frame_prefix'] else [('/tf', 'tf'), ('/tf_static', 'tf_static')]
    return Node(
        package=package,
        executable=package,
        namespace=given['namespace'],
        parameters=[{'use_sim_time': given['use_sim_time'] == 'true'}, *parameters],
        remappings=own_tf,
        arguments=arguments,
        output='screen',
    )
