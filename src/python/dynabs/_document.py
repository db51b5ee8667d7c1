"""Documents of Python as the JSON of a model file."""

import json

import numpy as np


def text(document):
    """The JSON of a document; arrays and NumPy's numbers become lists and numbers, each as its shortest decimal."""
    return json.dumps(document, default=_plain)


def _plain(value):
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, (set, frozenset, range)):
        return list(value)
    raise TypeError(f"found {type(value).__name__} in a problem; expected what JSON has, or arrays of NumPy")
