"""CSV and other text with a line of names, and NPZ, by numpy."""
import re

import numpy as np

from .errors import InputError


def read(path):
    return read_npz(path) if path.suffix.lower() == ".npz" else [read_text(path)]


def read_text(path):
    """Columns separated by commas, semicolons, tabs or spaces; the first line names them."""
    with path.open(encoding="utf-8-sig") as file:
        header = file.readline().strip().lstrip("#").strip()
        separator = next((sign for sign in ",;\t" if sign in header), None)
        names = [name.strip().strip('"') for name in (header.split(separator) if separator else header.split())]
        if len(names) < 3 or any(re.fullmatch(r"[-+.\d]+(e[-+]?\d+)?", name, re.IGNORECASE) for name in names):
            raise InputError(f"its first line has to name the columns, as 'x,y,z,id'; it is '{header[:60]}'")
        if len(set(names)) < len(names):
            raise InputError(f"two of its columns have the same name: {', '.join(names)}")
        # A float64 is exact for all ids up to 2^53.
        table = np.loadtxt(file, delimiter=separator, ndmin=2) if has_lines(file) else np.empty((0, len(names)))
    if table.shape[1] != len(names):
        raise InputError(f"its first line names {len(names)} columns, the others have {table.shape[1]}")
    return dict(zip(names, table.T))


def has_lines(file):
    place = file.tell()
    found = bool(file.readline().strip())
    file.seek(place)
    return found


def read_npz(path):
    """Arrays of one frame, or of many: positions of the shape (frames, particles, 3), and ids that may be the same in all."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
        arrays = {name: archive[name] for name in archive.files}
    frames = max((len(array) for array in arrays.values() if array.ndim == 3), default=None)
    if frames is None:
        return [arrays]
    stacks = {name: array for name, array in arrays.items() if array.ndim == 3}
    count = next(iter(stacks.values())).shape[1]
    result = []
    for frame in range(frames):
        fields = {}
        for name, array in arrays.items():
            if array.ndim >= 2 and array.shape[:2] == (frames, count):
                fields[name] = array[frame]
            elif array.ndim == 1 and len(array) == count:
                fields[name] = array
            elif array.ndim == 3:
                raise InputError(f"'{name}' has the shape {array.shape}, other arrays {(frames, count)}")
        result.append(fields)
    return result
