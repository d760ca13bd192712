"""lamella.h for ctypes: structs, callbacks and signatures, in the header's order."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_void_p

from ._library import load

VERSION = 1
OK = 0
STOPPED = 130
RESUME = 1
FORCE = 2


class Sized(ctypes.Structure):
    """A struct whose first member is its size; all else begins as zero, which means what is usual."""

    def __init__(self, **members: object) -> None:
        super().__init__(struct_size=ctypes.sizeof(type(self)), **members)


VALUES = ctypes.CFUNCTYPE(c_int32, c_void_p, c_void_p, c_size_t, c_void_p)
RANGE = ctypes.CFUNCTYPE(c_int32, c_void_p, c_void_p, c_void_p, POINTER(c_double), POINTER(c_double))
PROGRESS = ctypes.CFUNCTYPE(c_int32, c_void_p, c_char_p, c_int32, c_int32)


class Error(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("status", c_int32),
        ("message", c_char_p),
        ("path", c_char_p),
        ("line", c_int32),
    ]


class Field(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("metric", c_int32),
        ("lower", c_double * 3),
        ("upper", c_double * 3),
        ("values", VALUES),
        ("user", c_void_p),
        ("identity", c_char_p),
        ("range", RANGE),
    ]


class Grading(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("least", c_double),
        ("greatest", c_double),
        ("values", VALUES),
        ("user", c_void_p),
        ("identity", c_char_p),
        ("range", RANGE),
    ]


class Mesh(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("vertices", c_void_p),
        ("vertex_count", c_size_t),
        ("triangles", c_void_p),
        ("triangle_count", c_size_t),
    ]


class BuildOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("threads", c_int32),
        ("cancel", c_void_p),
        ("progress", PROGRESS),
        ("user", c_void_p),
        ("plans", c_char_p),
    ]


class JobInfo(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("layer_count", c_int32),
        ("lower", c_double * 3),
        ("upper", c_double * 3),
        ("layer_height", c_double),
        ("has_supports", c_int32),
        ("name", c_char_p),
        ("identity", c_char_p),
    ]


class Structure(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("dimensions", c_int32),
        ("iterations", c_int32),
        ("converged", c_int32),
        ("element", c_double),
        ("full_compliance", c_double),
        ("compliance", c_double),
        ("volume", c_double),
        ("mass", c_double),
        ("largest_displacement", c_double),
        ("peak_stress", c_double),
        ("appearance", c_double),
        ("stiffest_appearance", c_double),
    ]


class AnalysisOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("model", c_int32),
        ("elements", c_int32),
        ("threads", c_int32),
        ("cancel", c_void_p),
    ]


class SectionInfo(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("layer", c_int32),
        ("z", c_double),
        ("thickness", c_double),
        ("lower", c_double * 2),
        ("upper", c_double * 2),
    ]


class Raster(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("columns", c_int32),
        ("rows", c_int32),
        ("lines", c_int32),
        ("x", c_double),
        ("y", c_double),
        ("pitch_x", c_double),
        ("pitch_y", c_double),
    ]


class RunsView(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("line_count", c_size_t),
        ("first", c_void_p),
        ("ends", c_void_p),
    ]


class ContoursView(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("count", c_size_t),
        ("first", c_void_p),
        ("points", c_void_p),
        ("parent", c_void_p),
        ("area", c_double),
    ]


class Polygons(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("count", c_size_t),
        ("first", c_void_p),
        ("points", c_void_p),
    ]


class RunOptions(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("threads", c_int32),
        ("look_ahead", c_int32),
        ("first", c_int32),
        ("last", c_int32),
        ("flags", c_uint32),
        ("cancel", c_void_p),
        ("progress", PROGRESS),
        ("user", c_void_p),
    ]


class RunReport(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("layers_written", c_int32),
        ("layers_kept", c_int32),
        ("volume", c_double),
        ("support_volume", c_double),
    ]


class Product(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("data", c_void_p),
        ("area", c_double),
        ("support_area", c_double),
    ]


BEGIN = ctypes.CFUNCTYPE(c_int32, c_void_p, POINTER(JobInfo), c_int32, c_int32, c_uint32, POINTER(c_int32))
RENDER = ctypes.CFUNCTYPE(c_int32, c_void_p, c_void_p, c_void_p, POINTER(Product))
WRITE = ctypes.CFUNCTYPE(c_int32, c_void_p, POINTER(SectionInfo), POINTER(Product))
END = ctypes.CFUNCTYPE(c_int32, c_void_p)
DROP = ctypes.CFUNCTYPE(None, c_void_p, c_void_p)
ERROR = ctypes.CFUNCTYPE(c_void_p, c_void_p)


class Backend(Sized):
    _fields_ = [
        ("struct_size", c_uint32),
        ("user", c_void_p),
        ("begin", BEGIN),
        ("render", RENDER),
        ("write", WRITE),
        ("end", END),
        ("drop", DROP),
        ("error", ERROR),
    ]


# Objects are opaque (c_void_p), and so is the context, which most functions take first.
_one = (c_void_p,)
_signatures: dict[str, tuple[object, tuple]] = {
    "abi_version": (c_uint32, ()),
    "version": (c_char_p, ()),
    "status_name": (c_char_p, (c_int32,)),
    "context_create": (c_int32, (c_uint32, POINTER(c_void_p))),
    "context_destroy": (None, _one),
    "last_error": (c_int32, (c_void_p, POINTER(Error))),
    "cancel_create": (c_int32, (c_void_p, POINTER(c_void_p))),
    "cancel_destroy": (None, _one),
    "cancel_request": (None, _one),
    "recipe_create": (c_int32, (c_void_p, POINTER(c_void_p))),
    "recipe_destroy": (None, _one),
    "recipe_read": (c_int32, (c_void_p, c_char_p, POINTER(c_void_p))),
    "recipe_add_text": (c_int32, (c_void_p, c_void_p, c_char_p, c_size_t, c_char_p)),
    "recipe_set": (c_int32, (c_void_p, c_void_p, c_char_p, c_char_p)),
    "recipe_add_printers": (c_int32, (c_void_p, c_void_p, c_char_p)),
    "recipe_add_field": (c_int32, (c_void_p, c_void_p, c_char_p, POINTER(Field))),
    "recipe_add_mesh": (c_int32, (c_void_p, c_void_p, c_char_p, POINTER(Mesh))),
    "recipe_add_grading": (c_int32, (c_void_p, c_void_p, c_char_p, POINTER(Grading))),
    "job_build": (c_int32, (c_void_p, c_void_p, POINTER(BuildOptions), POINTER(c_void_p))),
    "job_destroy": (None, _one),
    "job_info_get": (c_int32, (c_void_p, c_void_p, POINTER(JobInfo))),
    "job_layer_height": (c_int32, (c_void_p, c_void_p, c_int32, POINTER(c_double))),
    "job_layer_z": (c_int32, (c_void_p, c_void_p, c_int32, POINTER(c_double))),
    "job_values": (c_int32, (c_void_p, c_void_p, c_void_p, c_size_t, c_void_p)),
    "job_structure": (c_int32, (c_void_p, c_void_p, POINTER(AnalysisOptions), POINTER(Structure))),
    "section_open": (c_int32, (c_void_p, c_void_p, c_double, POINTER(c_void_p))),
    "section_open_layer": (c_int32, (c_void_p, c_void_p, c_int32, POINTER(c_void_p))),
    "section_destroy": (None, _one),
    "section_info_get": (c_int32, (c_void_p, c_void_p, POINTER(SectionInfo))),
    "section_coverage": (c_int32, (c_void_p, c_void_p, c_int32, POINTER(Raster), c_void_p, c_size_t)),
    "section_runs": (c_int32, (c_void_p, c_void_p, c_int32, POINTER(Raster), POINTER(c_void_p))),
    "runs_destroy": (None, _one),
    "runs_view_get": (c_int32, (c_void_p, c_void_p, POINTER(RunsView))),
    "section_contours": (c_int32, (c_void_p, c_void_p, c_int32, c_double, POINTER(c_void_p))),
    "section_fill": (
        c_int32,
        (c_void_p, c_void_p, c_int32, POINTER(Polygons), c_double, POINTER(c_void_p)),
    ),
    "contours_destroy": (None, _one),
    "contours_view_get": (c_int32, (c_void_p, c_void_p, POINTER(ContoursView))),
    "run": (c_int32, (c_void_p, c_void_p, c_char_p, POINTER(RunOptions), POINTER(RunReport))),
    "run_backend": (
        c_int32,
        (c_void_p, c_void_p, POINTER(Backend), POINTER(RunOptions), POINTER(RunReport)),
    ),
}


def _declared(library: ctypes.CDLL, path: str) -> ctypes.CDLL:
    """The library with its signatures, once its interface is the one that is written down here."""
    try:
        found = library.lamella_abi_version()
        if found != VERSION:
            raise ImportError(
                f"{path}: has version {found} of Lamella's C interface; needed: version {VERSION}, that of a "
                "library as old as this package"
            )
        for name, (result, arguments) in _signatures.items():
            function = getattr(library, "lamella_" + name)
            function.restype, function.argtypes = result, arguments
    except AttributeError as error:
        raise ImportError(f"{path}: is not Lamella's library: {error}") from error
    return library


_loaded, loaded_from = load()
library = _declared(_loaded, loaded_from)
