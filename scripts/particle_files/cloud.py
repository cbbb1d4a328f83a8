"""sensor_msgs/PointCloud2 from particles."""
import numpy as np
from sensor_msgs.msg import PointCloud2, PointField

from .errors import InputError

POINT_FIELD_TYPES = {"i1": PointField.INT8, "u1": PointField.UINT8, "i2": PointField.INT16, "u2": PointField.UINT16,
                     "i4": PointField.INT32, "u4": PointField.UINT32, "f4": PointField.FLOAT32, "f8": PointField.FLOAT64}


def to_cloud(particles, stamp, frame_id, sequence):
    """Positions, ids, velocities if there are any, and all other fields, in this order."""
    with np.errstate(over="ignore"):
        columns = {name: particles.positions[:, axis].astype("<f4") for axis, name in enumerate("xyz")}
    if any(not np.isfinite(values).all() for values in columns.values()):
        raise InputError("positions are too large for FLOAT32")
    columns["id"] = particles.ids.astype("<u4")
    if particles.velocities is not None:
        columns.update({"v" + name: particles.velocities[:, axis].astype("<f4") for axis, name in enumerate("xyz")})
    columns.update({name: fitting(values) for name, values in particles.others.items()})
    # Aligned, because some readers take numbers where they are.
    rows = np.zeros(len(particles.positions), np.dtype([(name, values.dtype) for name, values in columns.items()], align=True))
    for name, values in columns.items():
        rows[name] = values
    return message(rows, stamp, frame_id, sequence)


def message(rows, stamp, frame_id, sequence):
    cloud = PointCloud2()
    cloud.header.stamp, cloud.header.frame_id, cloud.header.seq = stamp, frame_id, sequence
    cloud.fields = [PointField(name, offset, POINT_FIELD_TYPES[kind.str[1:]], 1)
                    for name, (kind, offset) in ((name, rows.dtype.fields[name][:2]) for name in rows.dtype.names)]
    cloud.height, cloud.width = 1, len(rows)
    cloud.point_step, cloud.row_step = rows.dtype.itemsize, rows.nbytes
    cloud.is_dense = True
    cloud.data = rows.tobytes()
    return cloud


def fitting(values):
    """In the nearest type that a cloud has: it has no integers of 64 bits."""
    if values.dtype.kind == "b":
        return values.astype("<u1")
    if values.dtype.kind == "f":
        return values.astype("<f8" if values.dtype.itemsize >= 8 else "<f4")
    if values.dtype.itemsize < 8:
        return values.astype(values.dtype.newbyteorder("<"))
    for kind in ("<u4", "<i4"):
        limits = np.iinfo(kind)
        if not len(values) or (values.min() >= limits.min and values.max() <= limits.max):
            return values.astype(kind)
    return values.astype("<f8")
