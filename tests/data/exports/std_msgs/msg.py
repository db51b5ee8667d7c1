class _Message:
    def __init__(self, data):
        self.data = data


class Float64MultiArray(_Message):
    pass


class UInt8(_Message):
    pass
