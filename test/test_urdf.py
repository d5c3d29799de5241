"""The description agrees with the parameter file and with the frames that nodes speak of."""

from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

from diffbot_sim.config import load_model
from diffbot_sim.nodes.conversions import BODY, JOINTS

ROOT = Path(__file__).parent.parent
URDF = ElementTree.parse(ROOT / 'urdf' / 'diffbot.urdf').getroot()
ROBOT = load_model(ROOT / 'config' / 'diffbot.yaml').robot
SIDES = {'left': 1.0, 'right': -1.0}


def part(kind: str, name: str) -> Element:
    (found,) = URDF.findall(f"{kind}[@name='{name}']")
    return found


def values(element: Element, path: str, key: str) -> list[float]:
    found = element.find(path)
    return [0.0] if found is None else [float(text) for text in found.get(key, '').split()]


def place(joint: str) -> list[float]:
    return values(part('joint', joint), 'origin', 'xyz')


def joint_of(link: str) -> Element:
    (found,) = URDF.findall(f"joint/child[@link='{link}']/..")
    return found


def test_every_part_hangs_directly_on_the_body():
    parts = {link.get('name') for link in URDF.findall('link')} - {BODY}
    children = [joint.find('child').get('link') for joint in URDF.findall('joint')]
    assert sorted(children) == sorted(parts)
    assert {joint.find('parent').get('link') for joint in URDF.findall('joint')} == {BODY}


def test_the_joints_that_turn_are_those_of_the_joint_states():
    turning = [j.get('name') for j in URDF.findall('joint') if j.get('type') != 'fixed']
    assert sorted(turning) == sorted(JOINTS)


@pytest.mark.parametrize('side', SIDES)
def test_a_wheel_rolls_forward_about_y_and_stands_on_the_floor(side):
    joint = part('joint', f'{side}_wheel_joint')
    assert joint.get('type') == 'continuous'
    assert values(joint, 'axis', 'xyz') == [0.0, 1.0, 0.0]
    y = SIDES[side] * ROBOT.wheel_separation / 2.0
    assert place(f'{side}_wheel_joint') == [0.0, y, ROBOT.wheel_radius]


@pytest.mark.parametrize('side', SIDES)
def test_a_wheel_looks_as_large_as_it_is(side):
    shapes = part('link', f'{side}_wheel').findall('.//cylinder')
    assert {float(shape.get('radius')) for shape in shapes} == {ROBOT.wheel_radius}


@pytest.mark.parametrize('side', SIDES)
def test_a_contact_lies_below_its_wheel_and_does_not_spin(side):
    assert joint_of(f'{side}_wheel_contact').get('type') == 'fixed'
    y = SIDES[side] * ROBOT.wheel_separation / 2.0
    assert place(f'{side}_wheel_contact_joint') == [0.0, y, 0.0]


def test_the_masses_add_up_to_the_robots():
    masses = [values(link, 'inertial/mass', 'value')[0] for link in URDF.findall('link')]
    assert sum(masses) == pytest.approx(ROBOT.mass)


def test_the_inertias_about_the_yaw_axis_add_up_to_the_robots():
    total = 0.0
    for link in URDF.findall('link[inertial]'):
        x, y, _ = values(joint_of(link.get('name')), 'origin', 'xyz')
        (mass,) = values(link, 'inertial/mass', 'value')
        total += values(link, 'inertial/inertia', 'izz')[0] + mass * (x**2 + y**2)
    assert total == pytest.approx(ROBOT.inertia, rel=1e-5)


def test_the_body_has_no_mass_of_its_own_as_kdl_asks_of_a_root():
    assert part('link', BODY).find('inertial') is None
