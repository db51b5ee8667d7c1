"""As much of ROS 2's Python as the exported node uses, to run it without ROS 2."""

from . import node

STATES = []
PUBLISHED = {}
_running = False


def init():
    global _running
    _running = True
    PUBLISHED.clear()


def shutdown():
    global _running
    _running = False


def spin(one):
    (topic, receive), (period, tick) = one.subscription, one.timer
    assert topic == "state" and period == 0.1
    tick()
    for x in STATES:
        if _running:
            receive(type("Message", (), {"data": list(x)}))
            tick()
