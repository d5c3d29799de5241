"""What RViz and PlotJuggler are to show can be read, and names our topics only."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

from diffbot_sim.nodes.conversions import BODY, WORLD
from diffbot_sim.nodes.recorder import KNOWN

CONFIG = Path(__file__).parent.parent / 'config'
RVIZ = ['diffbot.rviz', 'two_robots.rviz']
TOPICS = {
    *KNOWN,
    *(f'{s}_wheel/{n}' for s in ('left', 'right') for n in ('velocity', 'velocity_reference')),
}


def manager(name: str) -> dict[str, Any]:
    return yaml.safe_load((CONFIG / name).read_text())['Visualization Manager']


def topics(node: Any) -> Iterator[str]:
    """Yield the value of every key that ends with Topic."""
    for key, value in node.items() if isinstance(node, dict) else ():
        yield from [value['Value']] if key.endswith('Topic') else topics(value)
    for item in node if isinstance(node, list) else ():
        yield from topics(item)


@pytest.mark.parametrize('name', RVIZ)
def test_rviz_shows_our_topics_only(name):
    plain = {
        topic.removeprefix('/robot1/').removeprefix('/robot2/') for topic in topics(manager(name))
    }
    assert plain
    assert plain <= TOPICS | {'robot_description', 'initialpose'}


@pytest.mark.parametrize('name', RVIZ)
def test_every_display_has_a_name_and_comes_with_rviz(name):
    displays = manager(name)['Displays']
    assert all(display['Class'].startswith('rviz_default_plugins/') for display in displays)
    assert len({display['Name'] for display in displays}) == len(displays)


def test_one_robot_is_seen_from_its_world_in_any_namespace():
    shown = manager('diffbot.rviz')
    assert shown['Global Options']['Fixed Frame'] == WORLD
    assert shown['Views']['Current']['Target Frame'] == BODY
    assert not any(topic.startswith('/') for topic in topics(shown))


def test_plotjuggler_draws_our_topics_only_and_subscribes_to_all_it_draws():
    root = ElementTree.parse(CONFIG / 'plotjuggler.xml').getroot()
    drawn = {curve.get('name').rsplit('/', 3)[0] for curve in root.iter('curve')}
    drawn = {topic.removesuffix('/twist') for topic in drawn}
    (chosen,) = root.iter('selected_topics')
    assert drawn == set(chosen.get('value').split(';'))
    assert {topic.removeprefix('/') for topic in drawn} <= TOPICS


def test_plotjuggler_finds_as_many_plots_as_each_splitter_promises():
    root = ElementTree.parse(CONFIG / 'plotjuggler.xml').getroot()
    for splitter in root.iter('DockSplitter'):
        assert len(splitter) == int(splitter.get('count')) == len(splitter.get('sizes').split(';'))
