"""Lamella: shapes into printable layers, section by section.

Lengths are millimetres in the part's own coordinates, areas mm^2, volumes mm^3.
"""

from __future__ import annotations

from ._abi import library as _native
from ._backend import Backend, Product
from ._cancel import Cancel
from ._contours import Contours
from ._errors import (
    CallError,
    ConstraintError,
    Error,
    FaultError,
    InputError,
    OutOfMemoryError,
    StoppedError,
)
from ._job import Job, Report
from ._job_info import JobInfo
from ._raster import Raster, Runs
from ._recipe import Recipe
from ._section import PART, SUPPORTS, Section, SectionInfo, What
from ._structure import Structure

__version__: str = _native.lamella_version().decode()

__all__ = [
    "PART",
    "SUPPORTS",
    "Backend",
    "CallError",
    "Cancel",
    "ConstraintError",
    "Contours",
    "Error",
    "FaultError",
    "InputError",
    "Job",
    "JobInfo",
    "OutOfMemoryError",
    "Product",
    "Raster",
    "Recipe",
    "Report",
    "Runs",
    "Section",
    "SectionInfo",
    "StoppedError",
    "Structure",
    "What",
]
