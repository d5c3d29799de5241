"""Parameter files: what is written is read back, and what is wrong is told at once."""

from math import inf
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diffbot_sim.config import load_model, model_from_mapping, model_to_mapping, save_model
from diffbot_sim.errors import ConfigError
from diffbot_sim.parameters import specs
from diffbot_sim.physics import Friction, Model, Robot
from diffbot_sim.physics.effects import Effect, library
from diffbot_sim.physics.effects.quadratic_drag import QuadraticDrag

SAMPLE = Path(__file__).parent.parent / 'config' / 'diffbot.yaml'


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / 'robot.yaml'
    path.write_text(text)
    return path


def parameters(tmp_path: Path, text: str) -> Path:
    """Write the lines of `text` below /**: ros__parameters."""
    lines = ''.join(f'    {line}\n' for line in text.splitlines())
    return written(tmp_path, f'/**:\n  ros__parameters:\n{lines}')


def message(path: Path) -> str:
    with pytest.raises(ConfigError) as caught:
        load_model(path)
    assert '\n' not in str(caught.value)
    return str(caught.value)


def within_bounds(kind: type[Effect] | type[Robot]) -> st.SearchStrategy[Effect | Robot]:
    bounds = {
        spec.name: st.sampled_from(spec.choices)
        if spec.choices
        else st.floats(spec.low, spec.high)
        for spec in specs(kind)
    }
    return st.builds(kind, **bounds)


models = st.builds(
    Model,
    robot=within_bounds(Robot),
    friction=st.builds(Friction, model=st.sampled_from(['coulomb', 'generalized'])),
    effects=st.lists(st.sampled_from(list(library().values())), unique=True).flatmap(
        lambda kinds: st.tuples(*map(within_bounds, kinds))
    ),
)


@given(model=models)
def test_a_saved_model_is_loaded_back_to_the_same_bits(tmp_path_factory, model):
    path = tmp_path_factory.mktemp('round') / 'model.yaml'
    save_model(model, path)
    assert load_model(path) == model


def test_every_parameter_of_the_library_has_bounds():
    known = [spec for kind in (Robot, *library().values()) for spec in specs(kind)]
    assert all(spec.choices or -inf < spec.low < spec.high < inf for spec in known)


def test_the_sample_file_holds_the_defaults():
    assert load_model(SAMPLE) == Model()


def test_whole_numbers_are_written_as_floats_so_that_ros_takes_them(tmp_path):
    path = tmp_path / 'model.yaml'
    save_model(Model(Robot(mass=12)).with_effect(QuadraticDrag(6)), path, 'fitted to drive_1')
    text = path.read_text()
    assert text.startswith('# fitted to drive_1\n')
    assert 'mass: 12.0' in text
    assert 'quadratic_drag: {coefficient: 6.0}' in text
    assert list(tmp_path.iterdir()) == [path]


def test_mapping_there_and_back_is_the_same_model():
    model = Model(Robot(mass=7.5)).with_effect(QuadraticDrag(2.5))
    assert model_from_mapping(model_to_mapping(model), 'here') == model


def test_missing_keys_take_their_defaults(tmp_path):
    path = parameters(tmp_path, 'robot: {mass: 3.5}\neffects:\n  quadratic_drag:')
    assert load_model(path) == Model(Robot(mass=3.5), effects=(QuadraticDrag(),))


def test_later_sections_win_whatever_the_form_of_their_key(tmp_path):
    path = written(
        tmp_path,
        '/**: {ros__parameters: {robot: {mass: 1.0, inertia: 0.1}}}\n'
        '/**/simulator: {ros__parameters: {robot.mass: 2.0}}\n'
        'fleet: {simulator: {ros__parameters: {robot: {inertia: 0.3}}}}\n'
        'pi_controller: {ros__parameters: {robot: {mass: 9.0}, effects: 3}}\n',
    )
    assert load_model(path).robot == Robot(mass=2.0, inertia=0.3)


def test_another_node_may_have_no_parameters(tmp_path):
    of_others = 'recorder: {ros__parameters: }\n'
    path = written(tmp_path, f'{of_others}simulator: {{ros__parameters: {{robot.mass: 2.0}}}}')
    assert load_model(path).robot.mass == 2.0


def test_numbers_may_be_written_as_ros_reads_them(tmp_path):
    assert load_model(parameters(tmp_path, 'robot: {mass: 2e1, inertia: 1}')).robot.mass == 20.0


def test_parameters_of_nodes_are_left_alone(tmp_path):
    path = parameters(tmp_path, 'rate: 100.0\nodometry_noise: {linear: 0.01}\nfrequency: 50.0')
    assert load_model(path) == Model()


def test_numbers_that_the_robot_has_may_stand_elsewhere_too(tmp_path):
    path = parameters(tmp_path, 'robot: {mass: 9.0}\nwheels: {mass: 0.4}')
    assert load_model(path) == Model(Robot(mass=9.0))


def test_all_faults_are_told_in_one_line_that_names_the_file(tmp_path):
    path = parameters(
        tmp_path, 'robot: {mas: 1.0, mass: -2.0}\neffects: {quadratic_drg: {coefficient: 1.0}}'
    )
    text = message(path)
    assert text.startswith(f'{path}: robot.mas: unknown parameter. Known: mass, ')
    assert 'robot.mass: -2.0 is not valid; mass (mass m) takes 0.001 to 100000 kg' in text
    assert 'effects.quadratic_drg: unknown effect. Known: ' in text
    assert text.endswith("Did you mean 'quadratic_drag'?")


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('robot: {mass: heavy}', "robot.mass: 'heavy' is not valid"),
        ('robot: {mass: true}', 'robot.mass: True is not valid'),
        ('robot: {mass: .nan}', 'robot.mass: nan is not valid'),
        ('robot: {mass: [1.0]}', 'robot.mass: [1.0] is not valid'),
        ('robot: 10.0', 'robot: 10.0 is no mapping. Its keys: mass, inertia'),
        ('friction: {model: sticky}', 'takes one of none, coulomb'),
        ('friction: {mu_coulomb: 0.9}', 'friction.mu_coulomb: 0.9 exceeds friction.mu_static'),
        ('effects: {quadratic_drag: 6.0}', 'effects.quadratic_drag: 6.0 is no mapping'),
        ('effects: {slope: {grade: 0.1}}', "Did you mean 'grade_y'?"),
        ('efects: {slope: {grade_x: 0.1}}', 'efects: unknown section. Known: robot, friction'),
        ('vehicle: {mass: 9.0}', 'vehicle.mass: no place for it. Write robot.mass'),
        ('mu_static: 0.1', 'mu_static: no place for it. Write friction.mu_static'),
        ('slope: {grade_x: 0.1}', 'slope: no place for it. Write effects.slope'),
    ],
)
def test_wrong_parameters_are_named_with_what_is_valid(tmp_path, text, expected):
    assert expected in message(parameters(tmp_path, text))


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('', 'empty'),
        ('just words', 'not a mapping'),
        ('other: {ros__parameters: {}}', "for the simulator. The file starts with '/**:'"),
        ('robot: {mass: 1.0}', "/robot/mass stands outside of 'ros__parameters'"),
        ('/**: {ros__parameters: {}, effects: {}}', "effects stands beside 'ros__parameters'"),
        ('/**: {ros__parameters: {ros__parameters: {}}}', 'stands below another one'),
        (
            '/a/simulator: {ros__parameters: {}}\nb: {simulator: {ros__parameters: {}}}',
            'several robots: /a, /b',
        ),
        (
            'simulator: {ros__parameters: {}}\nb: {simulator: {ros__parameters: {}}}',
            'several robots: /, /b',
        ),
        ('/**: {ros__parameters: }', 'ros__parameters holds None'),
        ('/**:\n  robot: [1.0', 'line 2: '),
        ('a: {b: 1,\n  b: 2}', 'line 2: b stands twice'),
        ('a: \x01', 'not YAML'),
    ],
)
def test_files_of_another_form_are_refused(tmp_path, text, expected):
    assert expected in message(written(tmp_path, text))


def test_a_missing_file_is_named(tmp_path):
    assert 'there is no such file' in message(tmp_path / 'nothing.yaml')
    assert 'cannot be read: Is a directory' in message(tmp_path)


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(ConfigError, match='cannot be written'):
        save_model(Model(), tmp_path / 'nowhere' / 'model.yaml')
