"""What the packages say of the project: read where the project says it, so that it is said once."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version():
    """The version in the project() of CMakeLists.txt."""
    return re.search(r"project\(lamella VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def python_project():
    """The [project] table of the Python package."""
    import tomllib
    with open(ROOT / "bindings/python/pyproject.toml", "rb") as file:
        return tomllib.load(file)["project"]
