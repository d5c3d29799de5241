"""Bags: rosbag2 recordings to arrays and back, without ROS."""

from diffbot_sim.bags.folder import check_replaceable
from diffbot_sim.bags.read import RecordedRun, read_run
from diffbot_sim.bags.topics import Topics
from diffbot_sim.bags.write import write_run, write_series, write_trajectory

__all__ = [
    'RecordedRun',
    'Topics',
    'check_replaceable',
    'read_run',
    'write_run',
    'write_series',
    'write_trajectory',
]
