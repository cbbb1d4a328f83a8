"""PCD 0.7: text, binary, and compressed with LZF. Debian has no PCL for Python that reads more than x y z."""
import ctypes
import ctypes.util
import struct

import numpy as np

from .errors import InputError

KINDS = {"F": "f", "I": "i", "U": "u"}


def read(path):
    with path.open("rb") as file:
        header = read_header(file)
        body = file.read()
    count = int(header["POINTS"][0])
    columns = columns_of(header)
    kind = header["DATA"][0]
    if kind == "ascii":
        return [from_text(body, columns, count)]
    if kind == "binary":
        layout = np.dtype([(name, numpy_type, shape) for name, numpy_type, shape in columns])
        require(body, layout.itemsize * count)
        return [fields_of(np.frombuffer(body, layout, count))]
    if kind == "binary_compressed":
        return [from_columns(decompressed(body), columns, count)]
    raise InputError(f"its data is '{kind}'; it must be ascii, binary or binary_compressed")


def read_header(file):
    header = {}
    for line in file:
        words = line.decode("ascii", "replace").split("#")[0].split()
        if words:
            header[words[0].upper()] = words[1:]
        if words[:1] == ["DATA"]:
            break
    missing = [name for name in ("FIELDS", "SIZE", "TYPE", "POINTS", "DATA") if not header.get(name)]
    if missing:
        raise InputError(f"its header lacks {', '.join(missing)}")
    header.setdefault("COUNT", ["1"] * len(header["FIELDS"]))
    return header


def columns_of(header):
    lists = [header[name] for name in ("FIELDS", "SIZE", "TYPE", "COUNT")]
    if len({len(values) for values in lists}) != 1:
        raise InputError("its header names more fields than sizes, types or counts, or fewer")
    columns = []
    for index, (name, size, kind, count) in enumerate(zip(*lists)):
        if kind not in KINDS:
            raise InputError(f"field '{name}' is of type '{kind}'; it must be F, I or U")
        # Padding is called "_", any number of times.
        columns.append((name if name != "_" else f"_{index}", f"<{KINDS[kind]}{size}", (int(count),)))
    return columns


def fields_of(rows):
    """Fields of one value become a column, others a table; padding is left out."""
    return {name: rows[name].squeeze(axis=1) if rows[name].shape[1] == 1 else rows[name]
            for name in rows.dtype.names if not name.startswith("_")}


def from_text(body, columns, count):
    lines = body.decode("ascii").split("\n")
    table = np.loadtxt(lines, dtype=np.float64, ndmin=2) if body.strip() else np.empty((0, 0))
    if len(table) < count:
        raise InputError(f"it is cut off: {len(table)} of {count} points are there")
    fields, begin = {}, 0
    for name, numpy_type, (width,) in columns:
        if not name.startswith("_"):
            values = table[:count, begin:begin + width].astype(numpy_type)
            fields[name] = values[:, 0] if width == 1 else values
        begin += width
    return fields


def from_columns(body, columns, count):
    """Compressed data holds all values of the first field, then those of the second."""
    require(body, sum(np.dtype(kind).itemsize * width for _, kind, (width,) in columns) * count)
    fields, begin = {}, 0
    for name, numpy_type, (width,) in columns:
        values = np.frombuffer(body, numpy_type, count * width, begin)
        begin += values.nbytes
        if not name.startswith("_"):
            fields[name] = values if width == 1 else values.reshape(count, width)
    return fields


def require(body, size):
    if len(body) < size:
        raise InputError(f"it is cut off: {len(body)} of {size} bytes of points are there")


def decompressed(body):
    if len(body) < 8:
        raise InputError("it is cut off: the sizes of the compressed points are missing")
    packed, size = struct.unpack_from("<II", body)
    require(body[8:], packed)
    library = ctypes.util.find_library("lzf")
    if library is None:
        raise InputError("its points are compressed, which takes liblzf: apt-get install liblzf1")
    result = ctypes.create_string_buffer(size)
    written = ctypes.CDLL(library).lzf_decompress(body[8:8 + packed], packed, result, size)
    if written != size:
        raise InputError("its compressed points are damaged")
    return result.raw
