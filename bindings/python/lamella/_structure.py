"""How a part bears its loads."""

from __future__ import annotations

from dataclasses import dataclass

from . import _abi

MODELS = ("auto", "elements", "law")


@dataclass(frozen=True)
class Structure:
    """How a part bears the loads of its recipe. Compliances are weighted sums over the load cases."""

    dimensions: int  # 2 for a plate, else 3
    iterations: int  # of the search that made the part; 0: it was only analysed
    converged: bool  # the search ended by its tolerance
    element: float  # edge of the finite elements along x, mm
    full_compliance: float  # with material everywhere, N mm
    compliance: float  # of the part, N mm
    volume: float  # share of the body that is solid; 0: not known, of a foam by its law
    mass: float  # g; 0: the material's density is not known
    largest_displacement: float  # over all load cases, mm
    peak_stress: float  # von Mises, over all load cases, MPa; 0 of a foam by its law
    appearance: float  # difference from the picture; 0: there is none
    stiffest_appearance: float  # the same of the stiffest part with as much material


def structure(told: _abi.Structure) -> Structure:
    return Structure(
        told.dimensions,
        told.iterations,
        bool(told.converged),
        told.element,
        told.full_compliance,
        told.compliance,
        told.volume,
        told.mass,
        told.largest_displacement,
        told.peak_stress,
        told.appearance,
        told.stiffest_appearance,
    )
