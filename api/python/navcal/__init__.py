# SPDX-License-Identifier: Apache-2.0
"""Recordings of small underwater vehicles: samples, calibration, simulation, diagnosis (libnavcal)."""
from navcal import _core
from navcal._core import *
from navcal.tables import columns, datasets, frames

__version__ = _core.__version__
# Messages then name navcal.BadInput, which is what a program catches.
for _name in dir(_core):
    if isinstance(getattr(_core, _name), type):
        getattr(_core, _name).__module__ = "navcal"
del _name
