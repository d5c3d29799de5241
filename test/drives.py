"""Drives to make bags of."""

from dataclasses import replace

import numpy as np

from diffbot_sim.bags.folder import Message
from diffbot_sim.bags.messages import odometry, wrench
from diffbot_sim.records import Commands, Odometry, Run

START = 1_700_000_000_123_456_789
TIME = np.arange(100) / 100.0
LEFT, RIGHT, ODOM = '/left_wheel/force', '/right_wheel/force', '/odom'


def drive(name: str = 'drive') -> Run:
    """Turn several times on the spot and forward, so that the yaw passes ±π."""
    force = np.column_stack([np.sin(9 * TIME), np.cos(9 * TIME)])
    motion = np.column_stack([np.cos(TIME), np.full(100, 12.0)])
    pose = np.column_stack([np.sin(TIME), TIME**2, 12.0 * TIME])
    return Run(name, Commands(TIME, force), Odometry(TIME, motion, pose))


def without_poses(run: Run) -> Run:
    """Return a run whose poses nobody filled: at another pace its own would deny its twists."""
    poses = np.zeros((len(run.odometry.time), 3))
    return replace(run, odometry=replace(run.odometry, pose=poses))


def messages(run: Run, prefix: str = '', start: int = START) -> list[Message]:
    """Make the messages of a run one by one, to be spoilt by the test."""
    assert run.odometry.pose is not None
    stamps = [start + round(time * 1e9) for time in run.odometry.time]
    rows = zip(stamps, run.commands.force, run.odometry.twist, run.odometry.pose, strict=True)
    return [
        message
        for stamp, (right, left), motion, pose in rows
        for message in (
            Message(stamp, prefix + RIGHT, wrench(stamp, '', right)),
            Message(stamp, prefix + LEFT, wrench(stamp, '', left)),
            Message(stamp, prefix + ODOM, odometry(stamp, motion, pose)),
        )
    ]


def stamped(message: Message, stamp: int) -> Message:
    """Return the message with another header stamp; the time of receipt stays."""
    time = message.content.header.stamp
    time = replace(time, sec=stamp // 10**9, nanosec=stamp % 10**9)
    header = replace(message.content.header, stamp=time)
    return message._replace(content=replace(message.content, header=header))
