"""Documents that are remade from the code, or compared with what runs."""

import re
import runpy
from pathlib import Path

import pytest
from ros_robot import Robot, running

ROOT = Path(__file__).parents[1]
DOCS = ROOT / 'docs'
PAGES = sorted([*ROOT.glob('*.md'), *DOCS.glob('*.md'), *ROOT.glob('benchmarks/*.md')])
# What every node has from rclpy, and what is there only when asked for.
OWN = ('parameter_events', 'rosout', '/clock', 'tf')
NODES = ('simulator', 'pi_controller')
SPACE = '/documented/'


def test_the_page_of_parameters_is_the_one_that_the_code_gives():
    page = runpy.run_path(str(DOCS / 'make_parameters.py'))['page']
    assert page() == (DOCS / 'parameters.md').read_text('utf-8')


@pytest.mark.parametrize('page', PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_every_link_to_another_page_leads_somewhere(page):
    text = page.read_text('utf-8')
    for link in re.findall(r'\]\((?!https?:)([^)\s]+)\)', text):
        name, _, anchor = link.partition('#')
        target = page.parent / name if name else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target.read_text('utf-8')), link


def anchors(text):
    """Return what the headings of a page are called in links to them."""
    headings = re.findall(r'^#+ (.*)$', text, re.MULTILINE)
    return {re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in headings}


@pytest.fixture(scope='module')
def robot(tmp_path_factory):
    """Start the nodes that the tables tell of."""
    logs, space = (
        tmp_path_factory.mktemp('documented'),
        ('--ros-args', '-r', f'__ns:={SPACE[:-1]}'),
    )
    simulator, loop = (running(logs / node, node, *space) for node in NODES)
    with Robot(SPACE[:-1]) as robot, simulator, loop:
        robot.until(lambda: set(NODES) <= set(robot.node.get_node_names()))
        yield robot


def told(heading):
    """Return topic or service, type and direction of every row of a table."""
    text = (DOCS / 'ros.md').read_text('utf-8')
    table = text[text.index(heading) :].partition('\n\n|')[2].partition('\n\n')[0]
    rows = [line.strip('|').split('|') for line in table.splitlines()[2:]]
    names = ((re.findall('`([^`]+)`', row[0]), *map(str.strip, row[1:3])) for row in rows)
    return {(n, kind, way) for listed, kind, way in names for n in listed if n not in OWN}


def offered(names_and_types, way):
    found = ((name.removeprefix(SPACE), kinds[0].split('/')) for name, kinds in names_and_types)
    return {
        (name, f'{kind[0]}/{kind[-1]}', way)
        for name, kind in found
        if name.removeprefix('/') not in OWN
    }


@pytest.mark.parametrize('name', NODES)
def test_the_topics_of_a_node_are_the_documented_ones(robot, name):
    def seen():
        heard = robot.node.get_subscriber_names_and_types_by_node(name, SPACE[:-1])
        spoken = robot.node.get_publisher_names_and_types_by_node(name, SPACE[:-1])
        return offered(heard, 'in') | offered(spoken, 'out')

    robot.until(lambda: seen() == told(f'`{name}`\n'))


def test_the_services_of_the_simulator_are_the_documented_ones(robot):
    def seen():
        services = robot.node.get_service_names_and_types_by_node('simulator', SPACE[:-1])
        return {item for item in offered(services, '') if item[1].startswith('std_srvs/')}

    documented = {(name, kind, '') for name, kind, _ in told('## Services')}
    robot.until(lambda: seen() == documented)
