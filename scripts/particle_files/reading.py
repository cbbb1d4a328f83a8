"""Files of a sequence: which there are, in which order, and who reads them."""
import importlib
import pathlib
import re

from .errors import InputError

# Imported when needed: the libraries behind them are large, and nobody has to have them all.
READERS = {".ply": "ply_files", ".pcd": "pcd_files", ".vtk": "vtk_files", ".vtu": "vtk_files", ".vtp": "vtk_files",
           ".bgeo": "bgeo_files", ".csv": "tables", ".txt": "tables", ".npz": "tables"}
COMPRESSED = {".gz": ".bgeo"}  # Houdini's name.bgeo.gz


def suffix_of(path):
    """`.ply`, …, in lower case; of `a.bgeo.gz` it is `.bgeo`."""
    suffix = path.suffix.lower()
    inner = COMPRESSED.get(suffix)
    return inner if inner and path.stem.lower().endswith(inner) else suffix


def in_natural_order(paths):
    """Frame 10 after frame 9, however many digits the simulator writes."""
    return sorted(paths, key=lambda path: [(int(part), "") if part.isdigit() else (-1, part)
                                           for part in re.split(r"(\d+)", str(path))])


def files_of(names):
    """The files of a sequence in order; a folder stands for all files in it that can be read."""
    paths = []
    for name in map(pathlib.Path, names):
        if not name.is_dir():
            paths.append(name)
            continue
        inside = [path for path in name.iterdir() if suffix_of(path) in READERS]
        suffixes = {suffix_of(path) for path in inside}
        if len(suffixes) != 1:
            raise InputError(f"folder '{name}' holds {'no particle files' if not inside else 'files of several formats'}: "
                             f"name the files ({', '.join(sorted(suffixes or READERS))})")
        paths += inside
    return in_natural_order(paths)


def read_frames(path):
    """All frames of a file, each a dictionary of names and arrays with one row per particle."""
    suffix = suffix_of(path)
    if suffix not in READERS:
        raise InputError(f"'{path}' is no format that can be read; there are: {', '.join(READERS)}")
    try:
        path.open("rb").close()
    except OSError as error:
        raise InputError(f"'{path}' cannot be opened: {error.strerror}") from error
    reader = importlib.import_module("." + READERS[suffix], __package__)
    try:
        return reader.read(path)
    except InputError as error:
        raise InputError(f"'{path}': {error}") from error
    # What a library throws at damaged files is not of any particular kind.
    except Exception as error:
        said = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"'{path}' is damaged or not of its format: {said}") from error
