"""The constants that the paper does not print: chosen in constants.yaml, with reasons."""

from dataclasses import dataclass, replace
from importlib.resources import as_file, files
from pathlib import Path

from diffbot_sim.config import load_model, load_section
from diffbot_sim.control.pi import Gains
from diffbot_sim.errors import ConfigError
from diffbot_sim.physics import Friction, Model, Robot

CONSTANTS_FILE = files('diffbot_sim.paper') / 'constants.yaml'


@dataclass(frozen=True)
class Constants:
    """The robot, its friction, and the gains of Fig. 13."""

    robot: Robot
    friction: Friction
    gains: Gains

    @property
    def model(self) -> Model:
        """The robot of Fig. 7: with generalized friction on both wheels."""
        return Model(self.robot, self.friction)

    def with_friction(self, kind: str) -> Model:
        """Return the robot with one of the basic friction models of Fig. 6."""
        return Model(self.robot, replace(self.friction, model=kind))


def load_constants(path: Path | None = None) -> Constants:
    """Read a parameter file, or the chosen constants.

    Raises ConfigError for values that no robot has, for effects, and for another friction model.
    """
    if path is None:
        with as_file(CONSTANTS_FILE) as chosen:
            return load_constants(chosen)
    model = load_model(path, '--constants')
    if model.effects:
        names = ', '.join(effect.name for effect in model.effects)
        raise ConfigError(f'{path}: effects ({names}): the paper has none. Leave them out.')
    if model.friction.model != 'generalized':
        raise ConfigError(
            f'{path}: friction.model: {model.friction.model!r}; the experiments choose the basic '
            "models themselves. Give 'generalized' and its four coefficients."
        )
    return Constants(model.robot, model.friction, load_section(path, 'pi', Gains, '--constants'))
