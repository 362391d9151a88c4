# SPDX-License-Identifier: GPL-3.0-or-later
"""Install a zip of the extension into a Blender without any, and render with it: install_extension.py ZIP PICTURE.

`test_package.py` runs it in a process of its own, where the zip is the only source of the engine and of moderngl.
"""

import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder

import bpy

MODULE = "bl_ext.user_default.svo_engine"


class WheelsOfTheExtension:
    """Finds moderngl and glcontext where Blender unpacks the extension's wheels, and hides all others."""

    @staticmethod
    def find_spec(name: str, _path: Sequence[str] | None, _target: object = None) -> ModuleSpec | None:
        if name not in {"moderngl", "glcontext"}:
            return None
        if spec := PathFinder.find_spec(name, [path for path in sys.path if "extensions" in path]):
            return spec
        raise ModuleNotFoundError(f"the extension brings no {name}")


def engines() -> set[str]:
    """The identifiers of all registered render engines."""
    return {getattr(cls, "bl_idname", "") for cls in bpy.types.RenderEngine.__subclasses__() if cls.is_registered}


def install(zip_path: str) -> None:
    """Install and enable, disable, enable again."""
    assert "SVO_ENGINE" not in engines()
    bpy.ops.extensions.package_install_files(filepath=zip_path, repo="user_default", enable_on_install=True)
    assert MODULE in bpy.context.preferences.addons, "it is not enabled"
    assert "SVO_ENGINE" in engines(), "it is not registered"
    bpy.ops.preferences.addon_disable(module=MODULE)
    assert "SVO_ENGINE" not in engines(), "it is still registered"
    bpy.ops.preferences.addon_enable(module=MODULE)
    assert "SVO_ENGINE" in engines(), "it is not registered again"


def render(picture: str) -> None:
    """Render Blender's default scene."""
    scene = bpy.context.scene
    scene.render.engine = "SVO_ENGINE"
    scene.svo.samples, scene.svo.resolution = 1, "32"
    scene.render.resolution_x, scene.render.resolution_y = 48, 32
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    assert len(set(bpy.data.images.load(picture).pixels[:])) > 8, "the picture is empty"


if __name__ == "__main__":
    sys.meta_path.insert(0, WheelsOfTheExtension)
    install(sys.argv[1])
    render(sys.argv[2])
    print("INSTALLED")
