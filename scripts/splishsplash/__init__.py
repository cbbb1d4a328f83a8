"""SPlisHSPlasH as a ROS node: its simulation, the parameters, and who listens."""
