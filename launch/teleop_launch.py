"""Start the robot as bringup does, and the keyboard that drives it in a window of its own.

A keyboard needs a terminal, and launch gives none to what it starts. So the teleop gets its own,
`terminal`; where that does not exist, launch says which command to give in a second one.
"""

from os import environ
from pathlib import Path
from shlex import split
from shutil import which

from ament_index_python.packages import get_packages_with_prefixes
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node

from launch import Action, LaunchContext, LaunchDescription

BRINGUP = PythonLaunchDescriptionSource(str(Path(__file__).with_name('bringup_launch.py')))
TELEOP = 'teleop_twist_keyboard'
MISSING = (
    f'{TELEOP} is not installed: no keyboard. '
    'Install it (ros-$ROS_DISTRO-teleop-twist-keyboard), or publish cmd_vel otherwise'
)


def generate_launch_description() -> LaunchDescription:
    """Declare the terminal; all other arguments are bringup's."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'terminal',
                default_value='xterm -e',
                description='opens a terminal with a command in it; none: say the command instead',
            ),
            IncludeLaunchDescription(BRINGUP),
            OpaqueFunction(function=_teleop),
        ]
    )


def _teleop(context: LaunchContext) -> list[Action]:
    given = context.launch_configurations
    if TELEOP not in get_packages_with_prefixes():
        return [LogInfo(msg=MISSING)]
    stamped = given['enable_stamped_cmd_vel'] == 'true'
    if not _opens(given['terminal']):
        return [LogInfo(msg=f'In a second terminal: {_command(given["namespace"], stamped)}')]
    return [
        Node(
            package=TELEOP,
            executable=TELEOP,
            namespace=given['namespace'],
            parameters=[{'stamped': stamped}],
            prefix=given['terminal'],
        )
    ]


def _opens(terminal: str) -> bool:
    words = split(terminal)
    return bool(words and which(words[0]) and environ.get('DISPLAY'))


def _command(namespace: str, stamped: bool) -> str:
    options = [f'-r __ns:=/{namespace.strip("/")}'] if namespace else []
    options += ['-p stamped:=true'] if stamped else []
    return ' '.join(
        [f'ros2 run {TELEOP} {TELEOP}', *(['--ros-args', *options] if options else [])]
    )
