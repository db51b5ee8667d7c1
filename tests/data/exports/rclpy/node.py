import rclpy


class _Publisher:
    def __init__(self, topic):
        self.all = rclpy.PUBLISHED.setdefault(topic, [])

    def publish(self, message):
        self.all.append(message.data)


class Node:
    def __init__(self, name):
        self.parameters = {}

    def create_publisher(self, kind, topic, depth):
        return _Publisher(topic)

    def create_subscription(self, kind, topic, receive, depth):
        self.subscription = (topic, receive)

    def create_timer(self, period, tick):
        self.timer = (period, tick)

    def declare_parameter(self, name, default):
        self.parameters[name] = default

    def get_parameter(self, name):
        return type("Parameter", (), {"value": self.parameters[name]})

    def get_logger(self):
        return type("Logger", (), {"info": staticmethod(lambda text: None)})
