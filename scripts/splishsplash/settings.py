"""The private parameters of the node."""
import dataclasses
import json
import pathlib

import rospy

from particle_files.errors import UsageError


@dataclasses.dataclass
class Settings:
    scene: pathlib.Path
    frames: int = 200
    frame_rate: float = 60.0  # [1/s]
    start_time: int = 1000  # Stamp of the first frame [s]; 0 would mean to ROS that there is no time yet.
    frame_id: str = "world"
    subscribers: int = 1  # So many nodes must listen before the first frame.
    max_ahead: int = 0  # Frames; 0: do not wait for the tracker.
    timeout: float = 0.0  # [s]; 0: for ever.


RANGES = {"frames": (1, 10**6), "frame_rate": (1e-3, 1e6), "start_time": (1, 2**31), "subscribers": (0, 1000),
          "max_ahead": (0, 10**6), "timeout": (0, 1e9)}


def read_settings():
    """Raises UsageError that names the parameter and its value."""
    given = rospy.get_param("~", {})
    fields = {field.name: field for field in dataclasses.fields(Settings)}
    unknown = sorted(given.keys() - fields.keys())
    if unknown:
        raise UsageError(f"there is no parameter ~{unknown[0]}; there are: {', '.join(fields)}")
    if not given.get("scene"):
        raise UsageError("~scene is not set; it is a scene file of SPlisHSPlasH (JSON)")
    settings = Settings(checked_scene(str(given.pop("scene"))))
    for name, value in given.items():
        setattr(settings, name, checked(name, fields[name].type, value))
    return settings


def checked(name, wanted, value):
    if wanted is float and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if type(value) is not wanted:
        raise UsageError(f"~{name} is '{value}'; it must be of type {wanted.__name__}")
    if name in RANGES and not RANGES[name][0] <= value <= RANGES[name][1]:
        raise UsageError(f"~{name} is {value}; it must lie in [{RANGES[name][0]:g}, {RANGES[name][1]:g}]")
    return value


def checked_scene(name):
    """SPlisHSPlasH ends the process where it cannot read its scene."""
    path = pathlib.Path(name).resolve()
    try:
        json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UsageError(f"~scene '{name}' cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise UsageError(f"~scene '{name}' is no JSON: {error}") from error
    return path
