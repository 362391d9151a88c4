# SPDX-License-Identifier: GPL-3.0-or-later
"""Texture coordinates: the matrix that a chain of Mapping nodes makes."""

from __future__ import annotations

import numpy as np
from mathutils import Euler

from .nodes import Port, constant_color, origin
from .reader import Reader


def lookup_from_native(reader: Reader, port: Port, native: tuple[str, ...]) -> np.ndarray:
    """Matrix (3, 4) f8 from native coordinates (x, y, z, 1) to those at which the texture node of `port` looks.

    native  the outputs of a Texture Coordinate node that give native coordinates, as an unlinked texture node has
    """
    at = port.input("Vector")
    return np.eye(4)[:3] if at is None else _at(reader, origin(at), native, is_texture=True)


def _at(reader: Reader, port: Port, native: tuple[str, ...], is_texture: bool) -> np.ndarray:
    """The matrix of what `port` gives; for an unlinked socket the constant, unless `is_texture`."""
    if port.is_constant:
        if is_texture:
            return np.eye(4)[:3]
        return np.c_[np.zeros((3, 3)), constant_color(port.socket)]
    node = port.node
    if node.bl_idname == "ShaderNodeMapping" and node.vector_type != "NORMAL":
        before = _at(reader, origin(Port(node.inputs["Vector"], port.groups)), native, is_texture=False)
        return _mapping(reader, port) @ np.r_[before, [[0, 0, 0, 1]]]
    if node.bl_idname == "ShaderNodeUVMap" and "UV" in native:
        reader.uv_maps.add(node.uv_map)
    elif node.bl_idname != "ShaderNodeTexCoord" or port.socket.identifier not in native or node.object:
        reader.guess(f"coordinates from output '{port.socket.name}' of node '{node.name}' are not supported; "
                    f"{native[0]} is used")
    return np.eye(4)[:3]


def _mapping(reader: Reader, port: Port) -> np.ndarray:
    """Matrix (3, 4) of one Mapping node."""
    location, rotation, scale = (np.array(reader.constant(port, name)) for name in ("Location", "Rotation", "Scale"))
    turn = np.array(Euler(rotation.tolist(), "XYZ").to_matrix())
    if port.node.vector_type == "TEXTURE":
        inverse = np.divide(1.0, scale, out=np.zeros(3), where=scale != 0)
        linear = inverse[:, None] * turn.T
        return np.c_[linear, -linear @ location]
    return np.c_[turn * scale, location if port.node.vector_type == "POINT" else np.zeros(3)]
