"""guardbit's live model: bit-exact fixed-point triangle rasterization."""

from ._guardbit import Drawing, Model, Walk

__all__ = ["Drawing", "Model", "Walk"]
