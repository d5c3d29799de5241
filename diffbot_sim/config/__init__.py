"""YAML to model and back: the ROS 2 parameter file that every node and tool reads."""

from diffbot_sim.config.file import load_model, load_section, save_model
from diffbot_sim.config.mapping import model_from_mapping, model_to_mapping

__all__ = ['load_model', 'load_section', 'model_from_mapping', 'model_to_mapping', 'save_model']
