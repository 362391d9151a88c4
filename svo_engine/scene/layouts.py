# SPDX-License-Identifier: GPL-3.0-or-later
"""Structs that the host and the shaders share, written once: numpy dtypes that lie in memory as std430 wants it.

`glsl()` is the text of `shaders/lib/layouts.glsl`; a test holds the two together. To change a struct, change it here
and run `python -m svo_engine.scene.layouts`.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

# GLSL type -> (numpy base, components, alignment in bytes) by the rules of std430
_TYPES = {"float": ("f4", 1, 4), "int": ("i4", 1, 4), "uint": ("u4", 1, 4), "vec2": ("f4", 2, 8), "uvec2": ("u4", 2, 8),
          "vec3": ("f4", 3, 16), "vec4": ("f4", 4, 16)}

Fields = tuple[tuple[str, str], ...]

# A placed mesh. rows: world_from_object, metres relative to the grid's centre. Its triangles are
# first_triangle ... + n_triangles of the scene's; first_work counts the triangles of all instances before it.
INSTANCE: Fields = (("row_x", "vec4"), ("row_y", "vec4"), ("row_z", "vec4"), ("first_triangle", "uint"),
                    ("n_triangles", "uint"), ("first_work", "uint"), ("first_slot", "uint"))

# `scene.types.Material`; textures are indices, -1 for none. program: which of shaders/evaluate turns it into a Point,
# PROGRAM_*: from PROGRAM_TREE on a structure of node trees each, whose values begin at first_value, baked
# with `detail` cells for each metre that others have one for, 0 for one cell a triangle
MATERIAL: Fields = (("base_color", "vec3"), ("alpha", "float"), ("emission", "vec3"), ("roughness", "float"),
                    ("specular_tint", "vec3"), ("metallic", "float"), ("ior", "float"), ("specular_level", "float"),
                    ("transmission", "float"), ("normal_strength", "float"), ("base_color_texture", "int"),
                    ("roughness_texture", "int"), ("metallic_texture", "int"), ("emission_texture", "int"),
                    ("alpha_texture", "int"), ("normal_texture", "int"), ("program", "uint"),
                    ("first_value", "uint"), ("detail", "float"), ("pass_index", "int"))

# What a ray must know of a material: which share of all rays it stops, and the texture that multiplies that, or -1
OPACITY: Fields = (("alpha", "float"), ("alpha_texture", "int"))

# What a material sends out: radiance and the texture that multiplies it, or -1; likewise the share of it that is there
EMISSION: Fields = (("color", "vec3"), ("color_texture", "int"), ("alpha", "float"), ("alpha_texture", "int"))

# `scene.types.Texture`; picture: the row of its image
TEXTURE: Fields = (("u_from_uv", "vec3"), ("picture", "uint"), ("v_from_uv", "vec3"), ("extension", "uint"),
                   ("closest", "uint"), ("channel", "int"), ("divides", "uint"),
                   ("share", "uint"), ("share_channel", "int"))

# `scene.types.Image`: texels first_word ... of all words, in `format` FORMAT_*. tile: its UDIM number, or 0; n_tiles:
# rows from here on that are tiles of the same image
PICTURE: Fields = (("first_word", "uint"), ("format", "uint"), ("width", "int"), ("height", "int"),
                   ("is_associated", "uint"), ("tile", "int"), ("n_tiles", "uint"))

# What trees ask for of an instance. low, size: the box of the mesh's generated coordinates, metres, object space;
# number: its place in the scene's order; first_row: of its mesh among the attributes; rest: where those positions of
# its mesh begin that generated coordinates are of, counted as attributes are, or NO_REST
SHOWN: Fields = (("color", "vec4"), ("low", "vec3"), ("random", "float"), ("size", "vec3"), ("object_index", "int"),
                 ("generated", "vec3"), ("first_row", "uint"), ("uv", "vec2"), ("number", "uint"),
                 ("rest", "uint"))

# A vertex that a material moves: a triangle that has it as its corner, in the device's numbers, and its normal in
# object space
MOVED_CORNER: Fields = (("normal", "vec3"), ("instance", "uint"), ("triangle", "uint"), ("corner", "uint"),
                        ("first_value", "uint"))

# `scene.types.Light`; axes are unit vectors, the lamp shines along -axis_z. size: half extents (AREA), radius in
# size.x (POINT, SPOT), tangent of half the angle in size.x (SUN). spot: cosine of half the angle, blend. table: first
# texel of what its nodes make of it, in table_size columns + 65536 rows; no rows: nothing
LIGHT: Fields = (("position", "vec3"), ("kind", "uint"), ("emitted", "vec3"), ("is_ellipse", "uint"),
                 ("axis_x", "vec3"), ("casts_shadow", "uint"), ("axis_y", "vec3"), ("spread", "float"),
                 ("axis_z", "vec3"), ("spot_cos", "float"), ("size", "vec2"), ("spot_blend", "float"),
                 ("soft_falloff", "uint"), ("falloff", "uint"), ("smoothing", "float"), ("table", "uint"),
                 ("table_size", "uint"))

# A node of a light tree: the box around its lights and their intensity [W sr^-1]; in a leaf, the light's index
LIGHT_NODE: Fields = (("low", "vec3"), ("intensity", "float"), ("high", "vec3"), ("light", "uint"))

# An emissive triangle: its number when the triangles of all instances are counted, and its leaf in the light tree
EMITTER: Fields = (("work", "uint"), ("instance", "uint"), ("triangle", "uint"), ("leaf", "uint"))

# One occupied voxel, whole surfaces averaged by area. voxel: 10 bits an axis. normal: octahedral, NO_NORMAL where
# the surfaces cancel. albedo_coverage: RGBA8
VOXEL: Fields = (("emission", "vec3"), ("voxel", "uint"), ("albedo_coverage", "uint"), ("normal", "uint"))

# The surfaces in one voxel whose normals are widest along one axis, averaged by area. position: metres relative to the
# grid's centre; normal: octahedral, its component along the axis positive; voxel: 10 bits an axis, above them the
# normal's axis; outer: two halves, how many voxels the outermost surface facing front or back lies beyond position;
# area: of all of them, ONE of bind/voxel_sums.glsl a voxel's face
SURFEL: Fields = (("position", "vec3"), ("normal", "uint"), ("voxel", "uint"), ("outer", "uint"), ("area", "uint"))

# What a surfel looks like, apart, for an edit of a material changes nothing else. Two texels
# through: the share of the albedo that sends light on to the other side
SURFEL_COLORS: Fields = (("albedo", "vec3"), ("through", "float"), ("emission", "vec3"))

# A node of a tree of boxes: two children, each its box and a reference: a node's index, or BVH_LEAF + a leaf's index
BVH_NODE: Fields = (("low_a", "vec3"), ("child_a", "uint"), ("high_a", "vec3"), ("child_b", "uint"),
                    ("low_b", "vec3"), ("high_b", "vec3"))

# A leaf of a mesh's tree: corners in object space, and the triangle's number in the scene
BVH_TRIANGLE: Fields = (("a", "vec3"), ("triangle", "uint"), ("b", "vec3"), ("c", "vec3"))

# A leaf of the tree of instances, in their order: rows of object_from_world, the root of the mesh's tree, and the
# largest coordinate in object space
BVH_INSTANCE: Fields = (("inv_x", "vec4"), ("inv_y", "vec4"), ("inv_z", "vec4"), ("root", "uint"), ("extent", "float"))

# What a tree is built from: box, reference, and tree << BVH_HEIGHT_BITS | height
CLUSTER: Fields = (("low", "vec3"), ("reference", "uint"), ("high", "vec3"), ("tree_height", "uint"))

STRUCTS = {"Instance": INSTANCE, "Material": MATERIAL, "Opacity": OPACITY, "Emission": EMISSION, "Texture": TEXTURE,
           "Picture": PICTURE, "Shown": SHOWN, "Light": LIGHT, "LightNode": LIGHT_NODE, "Emitter": EMITTER,
           "Voxel": VOXEL, "Surfel": SURFEL, "SurfelColors": SURFEL_COLORS, "BvhNode": BVH_NODE,
           "BvhTriangle": BVH_TRIANGLE, "BvhInstance": BVH_INSTANCE, "Cluster": CLUSTER, "MovedCorner": MOVED_CORNER}

CONSTANTS = {"FORMAT_SRGB8": 0, "FORMAT_LINEAR8": 1, "FORMAT_FLOAT": 2,
             "ATTRIBUTE_POINT": 1, "ATTRIBUTE_FACE": 2, "ATTRIBUTE_CORNER": 3, "ATTRIBUTE_INSTANCE": 4,
             "NO_REST": 0xffffffff, "WORDS_WIDTH": 4096, "WORDS_HEIGHT": 1024,
             "EXTENSION_REPEAT": 0, "EXTENSION_EXTEND": 1, "EXTENSION_CLIP": 2, "EXTENSION_MIRROR": 3,
             "FALLOFF_QUADRATIC": 0, "FALLOFF_LINEAR": 1, "FALLOFF_CONSTANT": 2,
             "LIGHT_POINT": 0, "LIGHT_SUN": 1, "LIGHT_SPOT": 2, "LIGHT_AREA": 3,
             "NO_NORMAL": 0x80008000,
             "BVH_LEAF": 0x80000000, "BVH_NONE": 0xffffffff, "BVH_HEIGHT_BITS": 6,
             "HIT_DONE": 0xfffffffe,
             "PROGRAM_MATTE": 0, "PROGRAM_PRINCIPLED": 1, "PROGRAM_TREE": 2,
             # what kind of ray has come to a point that a tree is evaluated at
             "RAY_CAMERA": 1, "RAY_DIFFUSE": 2, "RAY_GLOSSY": 4, "RAY_TRANSMISSION": 8, "RAY_SHADOW": 16,
             "RAY_REFLECTION": 32, "RAY_SINGULAR": 64, "RAY_DISC": 128,
             "POINT_SURFACE": 1, "POINT_LOBES": 2, "POINT_SMOOTH": 4, "POINT_BENDING": 8, "POINT_ROUGH": 16,
             "POINT_DONE": 32, "POINT_LIFTED": 64, "POINT_GLOWS": 128, "POINT_PASSES": 256, "POINT_TURNED": 512,
             "POINT_SHAPED": 1024, "POINT_HOLDOUT": 2048,
             # uvec4 a slot in bind/wave.glsl
             "HIT_PLANES": 3, "POINT_PLANES": 7, "LOBES_PLANES": 5, "ARRIVAL_PLANES": 3, "GLOSS_PLANES": 4,
             "PATH_PLANES": 3, "DRAW_PLANES": 2}


@cache
def dtype(struct: Fields) -> np.dtype:
    """The numpy dtype of `struct` with std430's offsets and its array stride."""
    names, formats, offsets, end, widest = [], [], [], 0, 4
    for name, kind in struct:
        base, n, alignment = _TYPES[kind]
        start = -(-end // alignment) * alignment
        names.append(name)
        formats.append((base, n) if n > 1 else base)
        offsets.append(start)
        end, widest = start + 4 * n, max(widest, alignment)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": -(-end // widest) * widest})


def glsl() -> str:
    """The text of shaders/lib/layouts.glsl."""
    lines = ["// SPDX-License-Identifier: GPL-3.0-or-later",
             "// Purpose: structs and numbers shared with the host. Generated by svo_engine/scene/layouts.py, which",
             "// explains each field; do not edit.", ""]
    lines += [f"const uint {name} = {value}u;" for name, value in CONSTANTS.items()]
    for name, struct in STRUCTS.items():
        lines += ["", f"struct {name} {{", *(f"    {kind} {field};" for field, kind in struct), "};"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    Path(__file__).parents[2].joinpath("shaders/lib/layouts.glsl").write_text(glsl(), encoding="ascii")
