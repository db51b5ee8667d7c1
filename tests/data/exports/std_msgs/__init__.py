"""Stands in for a package of ROS 2."""
