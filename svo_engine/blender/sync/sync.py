# SPDX-License-Identifier: GPL-3.0-or-later
"""The Scene of one viewport, or of one final render after another: an update redoes what Blender says has changed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ...scene.types import Scene
from ..extract import scene_camera
from ..extract.visibility import hiding_of
from .changes import Changes, Uid, changes_of, uid_of
from .images import KeptImages
from .materials import KeptMaterials, Read, joined, read_images_of, read_world_alone
from .meshes import KeptMeshes
from .moves import follow
from .same import keep, keep_fields
from .walk import Walk, seen_of, walk


class Sync:
    """In the Scene that comes next, all that has not changed is the same object as in the last one; if nothing has, so
    is the Scene. A viewport's Scene has no camera: what a viewport looks through is its own.

    n_walks, n_rows  how often all instances were visited, and how many rows were written since without that
    """

    def __init__(self) -> None:
        self.n_walks = self.n_rows = 0
        self.images = KeptImages()
        self.materials = KeptMaterials(self.images)
        self.meshes = KeptMeshes()
        self._scene: Scene | None = None
        self._walk: Walk | None = None
        self._world: Read | None = None
        self._graph: tuple[Uid, ...] = ()
        self._hides: tuple[Any, ...] = ()
        self._override: Uid = 0

    def update(self, depsgraph: Any, space: Any = None) -> Scene:
        """The Scene after all that `depsgraph.updates` names. SceneError if it cannot be rendered.

        space  the 3D viewport that is drawn: what is hidden in it alone is left out
        """
        changes = changes_of(depsgraph)
        if self._walk is None or changes.is_unclear or self._graph != _graph_of(depsgraph):
            return self.read(depsgraph, space)
        return self._safely(depsgraph, space, changes)

    def read(self, depsgraph: Any, space: Any = None) -> Scene:
        """The Scene read anew, for a depsgraph whose updates were not followed. What is the same stays the same."""
        self._walk = None
        self.images.distrust()
        self._graph = _graph_of(depsgraph)
        return self._safely(depsgraph, space, Changes(has_scene=True, has_world=True))

    def is_stale(self, space: Any) -> bool:
        """Whether an update is due although Blender has not asked for one; quick enough for each redraw."""
        return self._hides != hiding_of(space) or self.images.are_stale()

    def _safely(self, depsgraph: Any, space: Any, changes: Changes) -> Scene:
        """After an error nothing is known."""
        try:
            scene = self._updated(depsgraph, space, changes)
        except BaseException:
            self._walk = None
            raise
        self._scene = scene
        return scene

    def _updated(self, depsgraph: Any, space: Any, changes: Changes) -> Scene:
        stale = self.images.look(changes, self.materials.images_of)
        last, found = self._walk, None
        if last is not None and not stale and not changes.has_placing:
            found = self._followed(last, depsgraph, space, changes)
        if found is None:
            found = self._walked(depsgraph, space, changes, stale)
        self._walk = found
        if self._world is None or changes.has_world or changes.has_scene or stale:
            self._world = read_world_alone(_world_of(depsgraph), self.images)
        return self._assembled(depsgraph, space, found, self._world)

    def _followed(self, last: Walk, depsgraph: Any, space: Any, changes: Changes) -> Walk | None:
        """`last` after `changes`, without a walk; None if that does not do."""
        if (changes.has_scene or changes.moved) and self.materials.ask_more():
            return None
        if changes.has_scene:
            if (hiding_of(space), _override_uid(depsgraph)) != (self._hides, self._override):
                return None
            if seen_of(depsgraph, space) != last.seen:
                return None
        moved = follow(last, depsgraph, changes)
        if moved is None or not self.materials.follow(changes.materials):
            return None
        self.n_rows += moved[1]
        return moved[0]

    def _walked(self, depsgraph: Any, space: Any, changes: Changes, stale: frozenset[Uid]) -> Walk:
        self.n_walks += 1
        if self._walk is None:
            self.materials.forget()
            self.meshes.forget()
        self.materials.drop(changes.materials, stale)
        self.meshes.begin(changes.geometry, self._scene.meshes if self._scene else ())
        self._hides, self._override = hiding_of(space), _override_uid(depsgraph)
        found = walk(depsgraph, space, self.materials, self.meshes)
        self.meshes.end()
        self.materials.end()
        return found

    def _assembled(self, depsgraph: Any, space: Any, found: Walk, world: Read) -> Scene:
        used = self.materials.used()
        lamps = read_images_of(found.lights, self.images)
        self.images.keep_only(world.keys.union(lamps.keys, *(read.keys for read in used)))
        notes = dict.fromkeys((*found.notes, *lamps.notes, *world.notes))
        camera = None
        if space is None:
            camera = scene_camera(depsgraph, notes.setdefault, is_needed=depsgraph.mode == "RENDER")
        parts = {"meshes": found.meshes, "instances": found.instances, "lights": found.lights,
                 **joined(used, lamps, world), "camera": camera,
                 "film_transparent": depsgraph.scene_eval.render.film_transparent, "warnings": tuple(notes)}
        scene = self._kept(parts)
        self._walk = replace(found, meshes=scene.meshes, instances=scene.instances, lights=scene.lights)
        return scene

    def _kept(self, parts: dict[str, Any]) -> Scene:
        """The Scene of `parts`, each the last one's if it is the same; if all are, the last Scene."""
        last = self._scene
        if last is None:
            return Scene(**parts)
        parts["instances"] = keep_fields(last.instances, parts["instances"])
        parts = {name: keep(getattr(last, name), part) for name, part in parts.items()}
        return last if all(part is getattr(last, name) for name, part in parts.items()) else Scene(**parts)


def _graph_of(depsgraph: Any) -> tuple[Uid, ...]:
    """Other ones for another depsgraph."""
    return depsgraph.as_pointer(), uid_of(depsgraph.scene), depsgraph.view_layer.name, depsgraph.mode


def _world_of(depsgraph: Any) -> Any:
    return getattr(depsgraph.view_layer_eval, "world_override", None) or depsgraph.scene_eval.world


def _override_uid(depsgraph: Any) -> Uid:
    """Of the material that the view layer gives to all; 0 without one."""
    override = depsgraph.view_layer_eval.material_override
    return uid_of(override.original) if override else 0
