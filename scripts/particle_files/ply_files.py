"""PLY, by meshio: text or binary, with any scalar properties of the vertices."""
import contextlib
import io

import meshio

from .errors import InputError


def read(path):
    expected = number_of_vertices(path)
    if expected == 0:
        raise InputError("it has no vertices")
    # meshio ends the program at some errors, and prints them.
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said):
            mesh = meshio.read(path, file_format="ply")
    except SystemExit as error:
        raise InputError(said.getvalue().strip() or "it cannot be read") from error
    if len(mesh.points) != expected:
        raise InputError(f"it is cut off: {len(mesh.points)} of {expected} vertices are there")
    return [{"position": mesh.points, **mesh.point_data}]


def number_of_vertices(path):
    with path.open("rb") as file:
        if file.readline().strip() != b"ply":
            raise InputError("it does not begin with 'ply'")
        for line in file:
            words = line.split()
            if words[:2] == [b"element", b"vertex"]:
                return int(words[2])
            if words[:1] == [b"end_header"]:
                break
    raise InputError("its header has no vertices")
