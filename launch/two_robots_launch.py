"""Start two robots, robot1 and robot2, two metres apart in one world.

Each has its namespace, and its name before its frames; both are on /tf. They live on wall time,
for two simulators cannot share one /clock. All other arguments are bringup's, for both.
"""

from datetime import datetime
from pathlib import Path

from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

HERE = Path(__file__).parent
BRINGUP = PythonLaunchDescriptionSource(str(HERE / 'bringup_launch.py'))
VIEW = PythonLaunchDescriptionSource(str(HERE / 'view_launch.py'))
CONFIG = PathJoinSubstitution([FindPackageShare('diffbot_sim'), 'config', 'two_robots.rviz'])
STARTS = {'robot1': '1.0', 'robot2': '-1.0'}  # y [m]


def generate_launch_description() -> LaunchDescription:
    """Declare what differs from bringup, and include that twice."""
    return LaunchDescription(
        [
            DeclareLaunchArgument('use_sim_time', default_value='false', choices=['false']),
            DeclareLaunchArgument(
                'output',
                default_value=f'{datetime.now():rosbag2_%Y_%m_%d-%H_%M_%S}',
                description='folders of the bags, less _robot1 and _robot2',
            ),
            DeclareLaunchArgument('rviz', default_value='false', choices=['true', 'false']),
            _view(),
            *(_robot(name, y) for name, y in STARTS.items()),
        ]
    )


def _robot(name: str, y: str) -> GroupAction:
    own = {
        'namespace': name,
        'frame_prefix': f'{name}/',
        'initial_pose.y': y,
        'output': [LaunchConfiguration('output'), f'_{name}'],
        'rviz': 'false',  # one window shows both
    }
    return GroupAction([IncludeLaunchDescription(BRINGUP, launch_arguments=own.items())])


def _view() -> GroupAction:
    own = {'description': 'false', 'rviz': 'true', 'rviz_config': CONFIG}
    show = IncludeLaunchDescription(VIEW, launch_arguments=own.items())
    asked = IfCondition(LaunchConfiguration('rviz'))
    return GroupAction([show, *(_in_the_world(name) for name in STARTS)], condition=asked)


def _in_the_world(name: str) -> Node:
    """Say that a robot's odometry starts at the origin of the world."""
    frames = ['--frame-id', 'world', '--child-frame-id', f'{name}/odom']
    return Node(
        package='tf2_ros',
        executable='static_transform_publisher',
        name=f'{name}_in_the_world',
        arguments=frames,
    )
