"""Shapes whose sections are known in closed form, for the tests."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

import lamella

RADIUS = 5.0


def ball_text(height: float = 0.5) -> str:
    return f'[part]\nshape = "sphere"\nradius = {RADIUS}\n[layers]\nheight = {height}\n'


def ball(height: float = 0.5) -> lamella.Job:
    return lamella.Recipe(ball_text(height)).build()


def ball_area(z: float) -> float:
    return math.pi * (RADIUS**2 - z**2)


def ball_values(points: np.ndarray) -> np.ndarray:
    return np.sqrt((points**2).sum(axis=1)) - RADIUS


def host_recipe(
    function: Callable[[np.ndarray], object], metric: str = "exact", height: float = 0.5
) -> lamella.Recipe:
    """A recipe whose part is a function over the ball's box."""
    recipe = lamella.Recipe()
    recipe["layers.height"] = height
    recipe.add_field("solid", function, [-RADIUS] * 3, [RADIUS] * 3, metric=metric, identity="test")
    return recipe


def box_text(size: tuple[float, float, float], height: float = 0.5) -> str:
    return f'[part]\nshape = "box"\nsize = {list(size)}\n[layers]\nheight = {height}\n'


def polygon_area(points: np.ndarray) -> float:
    """Signed: above zero where it runs counter-clockwise."""
    x, y = points.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)
