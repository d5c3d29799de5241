"""What holds for every test."""

import os

# Nodes under test must hear neither other machines nor a second test run on this one.
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(os.getpid() % 100 + 1)
