"""What holds for every test."""

import os

from hypothesis import settings

from diffbot_sim.__main__ import THREADS
from diffbot_sim.commands._processes import free_domain

# As commands do, before numpy is loaded.
os.environ |= dict.fromkeys(THREADS, '1')
# Nodes under test must hear neither other machines nor a second test run on this one.
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(free_domain())

# The first example of a property may wait for the compiler; and the same tests run every time.
settings.register_profile('house', deadline=None, derandomize=True)
settings.load_profile('house')
