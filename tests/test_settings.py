# SPDX-License-Identifier: GPL-3.0-or-later
"""Every setting: its range, its choices, and the sentence that a wrong value is told with."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from svo_engine.errors import SvoError
from svo_engine.settings import RenderSettings, specs, with_text

DEFAULT = RenderSettings()
NUMBERS = [name for name, spec in specs().items() if spec.low is not None]
CHOICES = [name for name, spec in specs().items() if spec.choices]
SWITCHES = [name for name in specs() if isinstance(getattr(DEFAULT, name), bool)]


def test_every_setting_has_a_kind_of_its_own():
    assert sorted([*NUMBERS, *CHOICES, *SWITCHES]) == sorted(specs())


@pytest.mark.parametrize("name", specs())
def test_every_setting_is_explained(name):
    spec = specs()[name]
    assert spec.label and spec.group
    assert len(spec.description) > 10
    assert not spec.description.endswith(".")  # as Blender's tooltips
    assert all(identifier and label and sentence for identifier, label, sentence in spec.choices)


@pytest.mark.parametrize("name", NUMBERS)
def test_the_ends_of_a_range_are_in_it_and_what_lies_beyond_is_told(name):
    spec, kind = specs()[name], type(getattr(DEFAULT, name))
    assert spec.low is not None and spec.high is not None and spec.low < spec.high
    for value in (spec.low, spec.high):
        assert getattr(replace(DEFAULT, **{name: kind(value)}), name) == value
    step = 1 if kind is int else (spec.high - spec.low) / 1e6
    for value in (spec.low - step, spec.high + step, float("nan"), float("inf")):
        with pytest.raises(SvoError, match=rf"'{name}' is .*; it must lie between {spec.low} and {spec.high}"):
            replace(DEFAULT, **{name: value})


@pytest.mark.parametrize("name", CHOICES)
def test_a_choice_is_one_of_those_that_are_offered(name):
    known = [identifier for identifier, _, _ in specs()[name].choices]
    assert getattr(DEFAULT, name) in known
    for identifier in known:
        assert getattr(replace(DEFAULT, **{name: identifier}), name) == identifier
    with pytest.raises(SvoError, match=f"'{name}' is 'nonsense'; it can be {', '.join(known)}"):
        replace(DEFAULT, **{name: "nonsense"})


@pytest.mark.parametrize("name", SWITCHES)
@pytest.mark.parametrize(("text", "value"), [("true", True), ("ON", True), ("1", True),
                                             ("False", False), ("off", False), ("0", False)])
def test_a_switch_is_read_from_words(name, text, value):
    assert getattr(with_text(DEFAULT, name, text), name) is value


@pytest.mark.parametrize("name", NUMBERS)
def test_a_number_is_read_from_text(name):
    low = specs()[name].low
    found = getattr(with_text(DEFAULT, name, str(low)), name)
    assert found == low
    assert type(found) is type(getattr(DEFAULT, name))


@given(st.floats(0.05, 2.5))
def test_text_of_a_number_gives_the_number(value):
    assert with_text(DEFAULT, "cone_aperture", repr(value)).cone_aperture == value


@pytest.mark.parametrize(("name", "text", "sentence"), [
    ("nonsense", "1", "There is no setting 'nonsense'; there are method, "),
    ("samples", "many", "Setting 'samples' needs a value of type int, not 'many'"),
    ("samples", "4.5", "Setting 'samples' needs a value of type int, not '4.5'"),
    ("samples", "", "Setting 'samples' needs a value of type int, not ''"),
    ("time_limit", "soon", "Setting 'time_limit' needs a value of type float, not 'soon'"),
    ("specular_cone", "maybe", "Setting 'specular_cone' needs a value of type bool, not 'maybe'"),
    ("samples", "0", "Setting 'samples' is 0; it must lie between 1 and 65536"),
    ("resolution", "100", "Setting 'resolution' is '100'; it can be 32, 64, 128, 256"),
])
def test_wrong_text_is_told_in_one_sentence(name, text, sentence):
    with pytest.raises(SvoError) as caught:
        with_text(DEFAULT, name, text)
    assert str(caught.value).startswith(sentence)
    assert "\n" not in str(caught.value)


def test_reading_text_leaves_all_else_as_it_was():
    changed = with_text(DEFAULT, "samples", "5")
    assert replace(changed, samples=DEFAULT.samples) == DEFAULT
    assert DEFAULT.samples != 5
