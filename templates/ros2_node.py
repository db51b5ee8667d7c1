{{ module }}


class Loop:
    """One run, step by step."""

    def __init__(self):
        self.step = 0
        self.status = 0
        self.inputs = None
{% if memory %}        self.memory = START
{% endif %}
    def next(self, x):
        """The input of the next step in the state x (looked at once in GROUP steps), or None if the run has ended."""
        if self.status != 0:
            return None
        if self.step % GROUP == 0:
            self.status, self.inputs{% if memory %}, self.memory{% endif %} = control(x, self.step // GROUP{% if memory %}, self.memory{% endif %})
            if self.status != 0:
                return None
        self.step += 1
        return self.inputs[(self.step - 1) % GROUP]


def main():
    """A node of ROS 2 to begin with: it reads the state, and writes the input of every step.

    Topics: state and input (std_msgs/Float64MultiArray), status (std_msgs/UInt8; any but 0 ends the run, and the node). The
    parameter `period` is the time of one step in seconds. What the plant does once the run has ended is yours to say.
    """
    import rclpy
    from rclpy.node import Node
    from std_msgs.msg import Float64MultiArray, UInt8

    class Controller(Node):
        def __init__(self):
            super().__init__("dynabs_controller")
            self.loop = Loop()
            self.state = None
            self.input = self.create_publisher(Float64MultiArray, "input", 1)
            self.status = self.create_publisher(UInt8, "status", 1)
            self.create_subscription(Float64MultiArray, "state", self.receive, 1)
            self.declare_parameter("period", 0.1)
            self.create_timer(self.get_parameter("period").value, self.tick)

        def receive(self, message):
            self.state = np.array(message.data)

        def tick(self):
            if self.state is None:
                return
            u = self.loop.next(self.state)
            if u is not None:
                self.input.publish(Float64MultiArray(data=u.tolist()))
            self.status.publish(UInt8(data=self.loop.status))
            if self.loop.status != 0:
                self.get_logger().info(f"the run has ended with status {self.loop.status}")
                rclpy.shutdown()

    rclpy.init()
    rclpy.spin(Controller())


if __name__ == "__main__":
    main()
