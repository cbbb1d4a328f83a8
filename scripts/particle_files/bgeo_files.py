"""BGEO, version 5: points with numbers as partio writes them for Houdini and SPlisHSPlasH, packed with gzip or not.

Debian has no partio. What is not points (primitives, groups, attributes of the whole) is passed over; text attributes too.
"""
import gzip
import struct

import numpy as np

from .errors import InputError

HEADER = struct.Struct(">4sc9i")  # Magic, V, version, points, primitives, 2 groups, 4 numbers of attributes.
REAL, INTEGER, TEXT, VECTOR = 0, 1, 4, 5
NUMBERS = {REAL: ">f4", INTEGER: ">i4", VECTOR: ">f4"}


def read(path):
    data = path.read_bytes()
    if data[:2] == b"\x1f\x8b":
        data = unpacked(data)
    if data[:4] != b"Bgeo":
        raise InputError("it does not begin with 'Bgeo' (files of Houdini 12 and later have another format: save as .bgeo of "
                         "version 5, 'classic', or as .csv)")
    try:
        _, _, version, points, _, _, _, attributes, *_ = HEADER.unpack_from(data)
        if version != 5:
            raise InputError(f"it is of version {version}; version 5 can be read")
        layout, begin = layout_of(data, attributes)
        rows = np.frombuffer(data, layout, points, begin)
    except (struct.error, ValueError) as error:
        raise InputError("it is cut off") from error
    fields = {"position": rows["position"][:, :3]}
    for name in layout.names[1:]:
        if not name.startswith("text "):
            values = rows[name]
            fields[name] = values[:, 0] if values.shape[1] == 1 else values
    return [fields]


def unpacked(data):
    try:
        return gzip.decompress(data)
    except (EOFError, OSError, gzip.zlib.error) as error:
        raise InputError(f"it is cut off or damaged: {error}") from error


def layout_of(data, attributes):
    """The layout of one point, and where the points begin."""
    columns = [("position", ">f4", (4,))]  # x y z w
    place = HEADER.size
    for _ in range(attributes):
        (length,) = struct.unpack_from(">H", data, place)
        name = data[place + 2:place + 2 + length].decode("utf-8", "replace")
        size, kind = struct.unpack_from(">Hi", data, place + 2 + length)
        place += 2 + length + 6
        if kind in NUMBERS:
            place += 4 * size  # Defaults
            columns.append((name, NUMBERS[kind], (size,)))
        elif kind == TEXT:
            (choices,) = struct.unpack_from(">i", data, place)
            place += 4
            for _ in range(choices):
                (length,) = struct.unpack_from(">H", data, place)
                place += 2 + length
            columns.append((f"text {name}", ">i4", (size,)))
        else:
            raise InputError(f"attribute '{name}' is of type {kind}, which partio does not write")
    return np.dtype(columns), place
