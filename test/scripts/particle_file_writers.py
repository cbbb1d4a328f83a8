"""Small particle files of every format that particles_to_bag reads. Fields are names and arrays; vectors have three columns."""
import ctypes
import ctypes.util
import gzip
import struct

import meshio
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter


def scalars(fields):
    """Positions as x y z, velocities as vx vy vz, all others as they are."""
    result = {}
    for name, values in fields.items():
        if values.ndim == 2:
            prefix = "" if name == "position" else "v"
            result.update({prefix + axis: values[:, index] for index, axis in enumerate("xyz")})
        else:
            result[name] = values
    return result


def write_ply(path, fields, binary=True):
    columns = scalars(fields)
    points = np.column_stack([columns.pop(axis) for axis in "xyz"])
    meshio.write(path, meshio.Mesh(points, {}, point_data=columns), file_format="ply", binary=binary)


def write_vtk(path, fields, binary=True):
    data = vtkPolyData() if path.suffix == ".vtp" else vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(fields["position"], deep=True))
    data.SetPoints(points)
    for name, values in fields.items():
        if name != "position":
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            data.GetPointData().AddArray(array)
    writer = {".vtk": vtkUnstructuredGridWriter, ".vtu": vtkXMLUnstructuredGridWriter, ".vtp": vtkXMLPolyDataWriter}[path.suffix]()
    if path.suffix == ".vtk":
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
    else:
        (writer.SetDataModeToAppended if binary else writer.SetDataModeToAscii)()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.Write()


def write_csv(path, fields, separator=","):
    columns = scalars(fields)
    rows = [separator.join(columns)]
    rows += [separator.join(repr(value.item()) for value in row) for row in zip(*columns.values())]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")


def write_npz(path, fields):
    np.savez(path, **fields)


def write_pcd(path, fields, kind="binary"):
    columns = scalars(fields)
    count = len(fields["position"])
    header = ["# .PCD v0.7", "VERSION 0.7", "FIELDS " + " ".join(columns),
              "SIZE " + " ".join(str(values.dtype.itemsize) for values in columns.values()),
              "TYPE " + " ".join({"f": "F", "i": "I", "u": "U"}[values.dtype.kind] for values in columns.values()),
              "COUNT " + " ".join("1" for _ in columns), f"WIDTH {count}", "HEIGHT 1", "VIEWPOINT 0 0 0 1 0 0 0",
              f"POINTS {count}", f"DATA {kind}"]
    path.write_bytes("\n".join(header).encode() + b"\n" + pcd_body(columns, count, kind))


def pcd_body(columns, count, kind):
    if kind == "ascii":
        return "".join(" ".join(repr(value.item()) for value in row) + "\n" for row in zip(*columns.values())).encode()
    if kind == "binary":
        rows = np.zeros(count, [(name, values.dtype) for name, values in columns.items()])
        for name, values in columns.items():
            rows[name] = values
        return rows.tobytes()
    plain = b"".join(values.tobytes() for values in columns.values())
    packed = ctypes.create_string_buffer(2 * len(plain) + 100)
    size = ctypes.CDLL(ctypes.util.find_library("lzf")).lzf_compress(plain, len(plain), packed, len(packed))
    return struct.pack("<II", size, len(plain)) + packed.raw[:size]


def write_bgeo(path, fields, compressed=True):
    """As partio writes it: floats, integers and vectors; big-endian."""
    others = [(name, values) for name, values in fields.items() if name != "position"]
    count = len(fields["position"])
    data = struct.pack(">4sc9i", b"Bgeo", b"V", 5, count, 0, 0, 0, len(others), 0, 0, 0)
    layout = [("position", ">f4", 4)]
    for name, values in others:
        width = 1 if values.ndim == 1 else values.shape[1]
        kind = 5 if width == 3 else 0 if values.dtype.kind == "f" else 1
        data += struct.pack(">H", len(name)) + name.encode() + struct.pack(">Hi", width, kind) + bytes(4 * width)
        layout.append((name, ">i4" if kind == 1 else ">f4", width))
    rows = np.zeros(count, layout)
    rows["position"][:, :3], rows["position"][:, 3] = fields["position"], 1
    for name, values in others:
        rows[name] = values
    data += rows.tobytes() + b"\x00\xff"
    path.write_bytes(gzip.compress(data) if compressed else data)
