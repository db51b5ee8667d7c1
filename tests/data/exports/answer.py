"""Answers with the Python module and the node of ROS 2, and compares the tables of .npz, .mat and the module."""

import sys

import numpy as np
import scipy.io

# What stands in for ROS 2 is beside this file.
sys.path.insert(0, ".")
import controller
import controller_ros2

n, width, runs, rounds, has_memory, length, steps = map(int, sys.argv[1:])
assert (controller.STATES, controller.GROUP * controller.INPUTS) == (n, width)

everything = []
with open("looks", "rb") as looks, open("python", "wb") as out:
    memory = getattr(controller, "START", None)
    for _ in range(rounds):
        x = np.fromfile(looks, "<f8", n * runs).reshape(runs, n)
        k = np.fromfile(looks, "<u4", runs)
        everything.append(x)
        carried = (memory,) if has_memory else ()
        status, u, *after = controller.control(x, k, *carried)
        assert u.shape == (runs, controller.GROUP, controller.INPUTS)
        assert np.isnan(u[status != 0]).all() and not np.isnan(u[status == 0]).any()
        # One state at a time gives the same.
        for i in range(0, runs, max(1, runs // 7)):
            alone = (np.broadcast_to(memory, runs)[i],) if has_memory else ()
            one = controller.control(x[i], k[i], *alone)
            assert one[0] == status[i] and np.array_equal(one[1], u[i], equal_nan=True)
        if has_memory:
            memory = after[0]
        status.astype("<u4").tofile(out)
        u.astype("<f8").tofile(out)
states = everything[0][:steps]

for wrong in [np.zeros(n + 1), np.zeros((2, 2, n)), 1.0]:
    try:
        controller.control(wrong)
        raise SystemExit(f"{wrong!r} is no state")
    except ValueError as error:
        assert "expected" in str(error)
for wrong in [-1, 0.5, [1, 2, 3]]:
    try:
        controller.control(np.zeros((2, n)), wrong)
        raise SystemExit(f"{wrong!r} is no number of steps")
    except ValueError as error:
        assert "expected" in str(error)

# The node's loop, step by step.
with open("ros2", "wb") as out:
    for i, x in enumerate(states):
        if i % length == 0:
            loop, held = controller_ros2.Loop(), np.zeros(controller.INPUTS)
        u = loop.next(x)
        held = held if u is None else u
        np.array([loop.status], "<u4").tofile(out)
        held.astype("<f8").tofile(out)

# The node itself, with what stands in for ROS 2: its first run.
import rclpy

rclpy.STATES = states[:length]
controller_ros2.main()
loop, inputs, statuses = controller_ros2.Loop(), [], []
for x in states[:length]:
    u = loop.next(x)
    statuses.append(loop.status)
    if u is None:
        break
    inputs.append(u.tolist())
assert (rclpy.PUBLISHED["input"], rclpy.PUBLISHED["status"]) == (inputs, statuses)

archive, matlab = np.load("controller.npz"), scipy.io.loadmat("controller.mat")
assert len(archive.files) == len([name for name in matlab if not name.startswith("__")])
assert str(archive["promise"]) == str(matlab["promise"][0])
sizes = {"states": n, "group_steps": controller.GROUP, "inputs": controller.INPUTS, "horizon": controller.HORIZON}
sizes["memories"] = getattr(controller, "START", 0)
assert {name: int(archive[name]) for name in sizes} == sizes
for name in archive.files:
    if name in sizes:
        assert matlab[name].item() == sizes[name]
    elif name != "promise":
        table = archive[name]
        module = getattr(controller, name.upper())
        assert table.dtype == module.dtype and np.array_equal(table, module), name
        column = table.reshape(-1, 1) if table.ndim == 1 else table
        assert column.dtype == matlab[name].dtype and np.array_equal(column, matlab[name]), name
        # For Octave to compare with.
        np.ascontiguousarray(column.T).astype("<f8").tofile(f"table_{name}")
