"""What a job says of itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import _abi


@dataclass(frozen=True, eq=False)
class JobInfo:
    """What a job says of itself."""

    layer_count: int
    bounds: np.ndarray  # of part and supports, (2, 3), mm
    layer_height: float  # mm
    has_supports: bool
    name: str  # of the part
    identity: str  # 32 digits: jobs that share them make the same layers


def job_info(told: _abi.JobInfo) -> JobInfo:
    return JobInfo(
        told.layer_count,
        np.array([told.lower[:], told.upper[:]]),
        told.layer_height,
        bool(told.has_supports),
        told.name.decode(),
        told.identity.decode(),
    )
