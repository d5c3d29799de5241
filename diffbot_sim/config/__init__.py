"""YAML to model or drive, and back: the files that every node and tool reads."""

from diffbot_sim.config.drive import load_drive, save_drive
from diffbot_sim.config.file import left_out, load_model, load_section, save_model
from diffbot_sim.config.mapping import model_from_mapping, model_to_mapping

__all__ = [
    'left_out',
    'load_drive',
    'load_model',
    'load_section',
    'model_from_mapping',
    'model_to_mapping',
    'save_drive',
    'save_model',
]
