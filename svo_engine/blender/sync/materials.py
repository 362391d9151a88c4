# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, each read by itself, so that an edit of one reads no other; then put together as the Scene has them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, replace
from typing import Any

from ...scene.types import Image, Light, Material, Texture, World
from ..extract.images import Images
from ..extract.lookups import asked_for
from ..extract.materials import Materials
from ..extract.textures import Textures
from ..extract.world import read_world
from .changes import Uid, uid_of
from .images import KeptImages, Key, key_of

_TEXTURES = tuple(f.name for f in fields(Material) if f.name.endswith("_texture"))


@dataclass(frozen=True, eq=False)
class Read:
    """A material or world as if there were no other: its textures and images are numbered from 0.

    keys   of the images
    asked  what a material's nodes ask of the instances that show it
    """

    what: Any
    textures: tuple[Texture, ...]
    images: tuple[Image, ...]
    keys: frozenset[Key]
    uv_maps: frozenset[str]
    notes: tuple[str, ...]
    asked: frozenset[tuple[str, str]] = frozenset()

    @property
    def uids(self) -> frozenset[Uid]:
        """Of the images."""
        return frozenset(uid for uid, _ in self.keys)


class KeptMaterials:
    """A Collector for `extract.placing.Placing`, for one walk after another."""

    def __init__(self, images: KeptImages) -> None:
        self.n_read = 0
        self.found: list[Material] = []
        self.uv_maps: list[set[str]] = []
        self.order: list[Uid] = []
        self._images = images
        self._read: dict[Uid, Read] = {}
        self._index: dict[Uid, int] = {}
        self._differing: set[Uid] = set()
        self._warn: Callable[[str], object] = lambda _sentence: None

    def begin(self, warn: Callable[[str], object]) -> None:
        """Before a walk: none is used yet."""
        self.found, self.uv_maps, self.order, self._index, self._warn = [], [], [], {}, warn
        self._differing = set()

    def end(self) -> None:
        """After a walk: what it has not used is given up."""
        self._read = {uid: self._read[uid] for uid in self.order}

    def index(self, material: Any) -> int:
        uid = uid_of(material.original) if material else 0
        if uid not in self._index:
            if uid not in self._read:
                self._read[uid] = self._read_alone(material)
            read = self._read[uid]
            for note in read.notes:
                self._warn(note)
            self._index[uid] = len(self.found)
            self.order.append(uid)
            self.found.append(read.what)
            self.uv_maps.append(set(read.uv_maps))
        return self._index[uid]

    def differ(self, index: int) -> None:
        self._differing.add(self.order[index])

    def forget(self) -> None:
        """Have all read again at the next walk."""
        self._read = {}

    def drop(self, materials: Iterable[Uid], images: frozenset[Uid]) -> None:
        """Have those materials read again at the next walk, and those that read these images."""
        for uid in [uid for uid, read in self._read.items() if read.uids & images] + list(materials):
            self._read.pop(uid, None)

    def follow(self, changed: dict[Uid, Any]) -> bool:
        """Read again those that are used, without a walk; False if that does not do: warnings stand in its order, and
        it looks up what they ask of instances."""
        for uid in changed.keys() & self._index.keys():
            last = self._read[uid]
            read = self._read[uid] = self._read_alone(changed[uid])
            if (read.notes, read.uv_maps, read.asked) != (last.notes, last.uv_maps, last.asked):
                return False
        return True

    def ask_more(self) -> bool:
        """Whether any that is used asks of instances what only a walk finds."""
        return any(self._read[uid].asked for uid in self.order)

    def images_of(self, uid: Uid) -> frozenset[Uid]:
        """The images that a material reads; none if nothing shows it."""
        return self._read[uid].uids if uid in self._read else frozenset()

    def used(self) -> list[Read]:
        """All that the last walk has found, in its order."""
        return [_differing(self._read[uid]) if uid in self._differing else self._read[uid] for uid in self.order]

    def _read_alone(self, material: Any) -> Read:
        self.n_read += 1
        notes: dict[str, None] = {}
        images = _Noted(notes.setdefault, self._images)
        materials = Materials(textures := Textures(images), images, notes.setdefault)
        materials.index(material)
        read = materials.found[0]
        return Read(read, tuple(textures.found), tuple(images.found), frozenset(images.keys),
                    frozenset(materials.uv_maps[0]), tuple(notes),
                    frozenset() if read.is_exact else asked_for(read.graph))


def _differing(read: Read) -> Read:
    return replace(read, what=replace(read.what, is_exact=False))


class _Noted(Images):
    """Images that tell whose they are."""

    def __init__(self, warn: Callable[[str], object], source: KeptImages) -> None:
        super().__init__(warn, source)
        self.keys: set[Key] = set()

    def _index(self, image: Any, frame: int) -> int:
        self.keys |= {key_of(image, frame)} if image else set()
        return super()._index(image, frame)


def read_world_alone(world: Any, source: KeptImages) -> Read:
    """The evaluated datablock `world`, or None."""
    notes: dict[str, None] = {}
    images = _Noted(notes.setdefault, source)
    read = read_world(world, images, notes.setdefault)
    return Read(read, (), tuple(images.found), frozenset(images.keys), frozenset(), tuple(notes))


def read_images_of(lights: tuple[Light, ...], source: KeptImages) -> Read:
    """What the graphs of lamps name."""
    notes: dict[str, None] = {}
    images = _Noted(notes.setdefault, source)
    for light in lights:
        images.add_named(light.graph)
    return Read(None, (), tuple(images.found), frozenset(images.keys), frozenset(), tuple(notes))


def joined(used: list[Read], lamps: Read, world: Read) -> dict[str, Any]:
    """Materials, textures, images and world of a Scene: each texture and image stands there once."""
    images: list[Image] = []
    textures: list[Texture] = []
    materials = []
    for read in used:
        image_of = _joined(read.images, images)
        texture_of = [_place(replace(texture, image=image_of[texture.image]), textures) for texture in read.textures]
        materials.append(_renumbered(read.what, texture_of))
    _joined(lamps.images, images)
    image_of = _joined(world.images, images)
    return {"materials": tuple(materials), "textures": tuple(textures), "images": tuple(images),
            "world": _turned(world.what, image_of)}


def _joined(own: tuple[Image, ...], images: list[Image]) -> list[int]:
    """Where each of `own` stands among all `images`, to which those that are new are added, tiles together."""
    known = {id(image): i for i, image in enumerate(images)}
    for image in own:
        if id(image) not in known:
            known[id(image)] = len(images)
            images.append(image)
    return [known[id(image)] for image in own]


def _renumbered(material: Material, texture_of: list[int]) -> Material:
    changed = {name: texture_of[i] for name in _TEXTURES if (i := getattr(material, name)) >= 0}
    return replace(material, **changed) if changed else material


def _turned(world: World, image_of: list[int]) -> World:
    return replace(world, image=image_of[world.image]) if world.image >= 0 else world


def _place(texture: Texture, found: list[Texture]) -> int:
    if texture not in found:
        found.append(texture)
    return found.index(texture)
