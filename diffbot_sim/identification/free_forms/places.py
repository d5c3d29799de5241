"""What a force may depend on: where on the floor the robot is."""

from diffbot_sim.identification.free_forms.floor import by_place
from diffbot_sim.identification.free_forms.forms import FINE_KNOTS, Piecewise
from diffbot_sim.identification.free_forms.patch import Patch
from diffbot_sim.identification.free_forms.quantities import (
    along,
    along_of_wheels,
    rolling,
    share_of_force,
    towards,
)
from diffbot_sim.identification.free_forms.round_hill import RoundHill
from diffbot_sim.identification.free_forms.variable import Variable
from diffbot_sim.identification.result import ROUND_HILL

A_PATCH = 'within {grid[2]:.2g} m of x = {grid[0]:.2g} m, y = {grid[1]:.2g} m'
PLACES = {
    'hill_x': Variable(
        'where along x it is, like the pull of a hill',
        'x [m]',
        Piecewise(along(0), towards(0), FINE_KNOTS),
        ('v',),
        by_place,
    ),
    'hill_y': Variable(
        'where along y it is, like the pull of a hill',
        'y [m]',
        Piecewise(along(1), towards(1), FINE_KNOTS),
        ('v',),
        by_place,
    ),
    ROUND_HILL: Variable(
        f'where it is, like the pull of a hill or a hollow {A_PATCH}',
        'distance from the middle of the hill or hollow [m]',
        RoundHill(),
        ('wheels',),
        by_place,
    ),
    'place_x': Variable(
        'where along x it rolls, against the motion',
        'x [m]',
        Piecewise(along_of_wheels(0), rolling, FINE_KNOTS),
        ('wheels',),
        by_place,
    ),
    'place_y': Variable(
        'where along y it rolls, against the motion',
        'y [m]',
        Piecewise(along_of_wheels(1), rolling, FINE_KNOTS),
        ('wheels',),
        by_place,
    ),
    'patch': Variable(
        f'whether each wheel is {A_PATCH}, against the motion',
        'distance from the middle of the patch [m]',
        Patch(rolling),
        ('wheels',),
        by_place,
    ),
    'force_over_patch': Variable(
        f'whether each wheel is {A_PATCH}, in proportion to the commanded force',
        'distance from the middle of the patch [m]',
        Patch(share_of_force),
        ('wheels',),
        by_place,
    ),
}
