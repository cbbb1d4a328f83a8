"""Particles of a frame, from the files that simulators and ParaView, Houdini or PCL write, to sensor_msgs/PointCloud2.

A reader (`vtk_files`, `ply_files`, `pcd_files`, `bgeo_files`, `tables`) returns the frames of one file, each a dictionary of
names and arrays; `fields` finds positions, velocities and ids among them, whatever they are called; `nearest` makes ids
where there are none; `cloud` makes the message.
"""
