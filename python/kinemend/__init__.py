"""Cleans human motion capture: jitter, spikes, gaps and sliding feet.

>>> import kinemend
>>> result = kinemend.clean("walk.bvh")
>>> kinemend.write(result.take, "walk.clean.bvh", overwrite=True)
>>> result.report.verdict
'noisy: ... jitter on 31 joints, ... spikes'

docs/python.md of the project is the guide.
"""

from . import cleaners
from ._commands import (
    Result,
    RobotLimits,
    check,
    clean,
    compare,
    contacts,
    corrupt,
    fill,
    train,
)
from ._core import Model, Take, version as __version__
from ._errors import Error
from ._files import diagnostics, losses, read, to_bytes, write
from ._live import LiveFilter, LiveFrame
from ._tables import (
    Cleaner,
    DamageKind,
    FileFormat,
    FillMethod,
    Method,
    Option,
    Training,
    damages,
    fill_methods,
    formats,
    methods,
    trainings,
)
from .arrays import (
    contact_masks,
    from_npz,
    global_matrices,
    local_matrices,
    local_rotations,
    to_npz,
    to_pandas,
)
from .reports import DamageReport, Report

__all__ = [
    "Cleaner",
    "DamageKind",
    "DamageReport",
    "Error",
    "FileFormat",
    "FillMethod",
    "LiveFilter",
    "LiveFrame",
    "Method",
    "Model",
    "Option",
    "Report",
    "Result",
    "RobotLimits",
    "Take",
    "Training",
    "__version__",
    "check",
    "clean",
    "cleaners",
    "compare",
    "contact_masks",
    "contacts",
    "corrupt",
    "damages",
    "diagnostics",
    "fill",
    "fill_methods",
    "formats",
    "from_npz",
    "global_matrices",
    "local_matrices",
    "local_rotations",
    "losses",
    "methods",
    "read",
    "to_bytes",
    "to_npz",
    "to_pandas",
    "train",
    "trainings",
    "write",
]
