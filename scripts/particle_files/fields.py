"""Which of a file's fields are positions, velocities and ids; what simulators call them differs."""
import dataclasses
import typing

import numpy as np

from .errors import InputError

POSITION_NAMES = ("position", "positions", "pos", "points", "coordinates", "p")
VELOCITY_NAMES = ("velocity", "velocities", "vel", "v")
ID_NAMES = ("id", "ids", "particle_id", "particleid", "idp", "origid", "global_id")
# Tables have vectors in columns: Points:0 (ParaView), pos_x, pos.x, posx.
COMPONENTS = ((":0", ":1", ":2"), ("_0", "_1", "_2"), ("[0]", "[1]", "[2]"), ("_x", "_y", "_z"), (".x", ".y", ".z"),
              ("x", "y", "z"))
LARGEST_ID = 2**32 - 1  # PointCloud2 has no integers of 64 bits.


@dataclasses.dataclass
class Particles:
    """The particles of one frame. Arrays have one row per particle."""

    positions: np.ndarray
    velocities: typing.Optional[np.ndarray]
    ids: typing.Optional[np.ndarray]  # None if the file has none
    others: dict  # Further scalar fields by name
    left_out: list  # Names of fields that a cloud cannot carry


def particles_of(fields, id_field=None):
    """Sorts the fields of a file. Raises InputError where they are no particles."""
    fields = {name: np.asarray(values) for name, values in fields.items()}
    positions = take_vector(fields, ("x", "y", "z"), POSITION_NAMES)
    if positions is None:
        raise InputError(f"it has no positions: no x, y, z among {names_of(fields)}")
    count = len(positions)
    wrong = [name for name, values in fields.items() if len(values) != count]
    if wrong:
        raise InputError(f"'{wrong[0]}' has {len(fields[wrong[0]])} rows, the positions have {count}")
    require_finite("positions", positions)
    velocities = take_vector(fields, ("vx", "vy", "vz"), VELOCITY_NAMES)
    if velocities is not None:
        require_finite("velocities", velocities)
    ids = take_ids(fields, id_field)
    others = {name: values for name, values in fields.items() if values.ndim == 1 and values.dtype.kind in "biuf"}
    reserved = {"x", "y", "z", "id", "vx", "vy", "vz"} & others.keys()
    for name in reserved:  # Such as vx without vy; a cloud with it would be refused.
        del others[name]
    return Particles(positions, velocities, ids, others, sorted(fields.keys() - others.keys()))


def take_vector(fields, columns, names):
    """Removes a vector from the fields and returns it, or None. Columns of their own come before arrays of vectors."""
    known = {name.lower(): name for name in fields}
    candidates = [columns] + [tuple(name + end for end in ends) for name in names for ends in COMPONENTS]
    for candidate in candidates:
        if all(name in known and fields[known[name]].ndim == 1 for name in candidate):
            parts = [fields.pop(known[name]) for name in candidate]
            if len({len(part) for part in parts}) != 1:
                raise InputError(f"{', '.join(candidate)} are not of the same length")
            return np.column_stack(parts)
    for name in names:
        if name in known and fields[known[name]].ndim == 2 and fields[known[name]].shape[1] == 3:
            return fields.pop(known[name])
    return None


def take_ids(fields, id_field):
    """Removes the ids from the fields and returns them as uint32, or None."""
    if id_field is not None:
        if id_field not in fields:
            raise InputError(f"it has no field '{id_field}' for the ids; it has {names_of(fields)}")
        return checked_ids(id_field, fields.pop(id_field))
    known = {name.lower(): name for name in fields}
    name = next((known[name] for name in ID_NAMES if name in known), None)
    return None if name is None else checked_ids(name, fields.pop(name))


def checked_ids(name, values):
    if values.ndim != 1 or values.dtype.kind not in "iuf":
        raise InputError(f"'{name}' cannot be ids: it holds no single numbers")
    if values.dtype.kind == "f":
        require_finite(f"ids in '{name}'", values)
        if np.any(values != np.floor(values)):
            raise InputError(f"'{name}' cannot be ids: {values[values != np.floor(values)][0]:g} is no whole number")
        limit = 2**(np.finfo(values.dtype).nmant + 1)
        if len(values) and values.max() >= limit:
            raise InputError(f"'{name}' cannot be ids: {values.dtype.name} holds whole numbers exactly below {limit} only, and the "
                             f"largest is {values.max():.0f}")
    if len(values) and (values.min() < 0 or values.max() > LARGEST_ID):
        outside = values.min() if values.min() < 0 else values.max()
        raise InputError(f"'{name}' cannot be ids: {outside:.0f} is not from 0 to {LARGEST_ID}")
    order = np.sort(values)
    twice = order[1:][order[1:] == order[:-1]]
    if len(twice):
        raise InputError(f"id {twice[0]:.0f} occurs more than once in '{name}'")
    return values.astype(np.uint32)


def require_finite(what, values):
    finite = np.isfinite(values)
    bad = ~(finite if finite.ndim == 1 else finite.all(axis=1))
    if bad.any():
        raise InputError(f"{np.count_nonzero(bad)} of {len(values)} {what} are not finite; the first is that of row "
                         f"{np.argmax(bad)}")


def names_of(fields):
    return ", ".join(sorted(fields)) or "nothing"
