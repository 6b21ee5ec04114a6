"""The package: words as the model's, and refusals that say why."""

from pathlib import Path
from types import MappingProxyType

import guardbit
import pytest

ROOT = Path(__file__).parents[3]
CORNER = [(0, 0), (8, 0), (0, 8)]
Q = [255, 128, 64]
CODES = {"color": [[0, 8], [8, 8], [16, 8]], "texcoord": [[40]] * 3, "face": [[1], [2], [3]]}


@pytest.fixture
def channels(tmp_path):
    """`tiny` with the channels color (r, g) affine, texcoord (u) by quotient, face (id) of the last vertex."""
    parts = [ROOT / "profiles/tiny.toml", ROOT / "bindings/c/tests/channels.toml"]
    path = tmp_path / "channels.toml"
    path.write_text("\n".join(part.read_text() for part in parts))
    return guardbit.Model(str(path))


def test_a_triangle_is_drawn():
    model = guardbit.Model("tiny")
    assert model.name == "tiny"
    drawing = model.draw([(0, 0, 0), (8, 0, 7), (0, 8, 7)])
    # x + y < 8 in half pixels: the sample of pixel (x, y) is at (2x + 1, 2y + 1).
    assert drawing.rows == [(0, 0, 3), (1, 0, 2), (2, 0, 1)]
    assert len(drawing.z) == 6
    assert not drawing.zero_area
    # E0 = 8 * (1 - 0) = 8 at the sample, kept without its lowest bit; a top edge owns its samples.
    assert dict(drawing.setup)["edge0_init"] == 4


def test_a_walk_wraps_and_reads_out():
    walk = guardbit.Model("tiny").depth_walk()
    assert walk.width == 7
    assert walk.clock(0, 8, 0, 0) == (8, 1)
    assert walk.clock(1, 0, 56, 0) == (64, 7)
    # 1 guard bit over 3 integer bits: pattern 1100 is the first that counts as below zero.
    assert walk.clock(1, 0, 32, 0) == (96, 0)
    assert walk.clock(3, 0, 1, 1) == (96, 0)


def test_an_edge_is_inside_when_its_sign_is_clear():
    walk = guardbit.Model("sgi-4k").edge_walk()
    assert walk.clock(0, 0, 0, 0) == (0, 1)
    assert walk.clock(1, 0, -1, 0) == ((1 << 35) - 1, 0)


def test_every_primitive_goes_through_one_door():
    tiny = guardbit.Model("tiny")
    # Half pixels: from (1, 1) to (5, 1), and the diamond of the last pixel is not left.
    assert tiny.draw(line=[(1, 1), (5, 1)]).rows == [(0, 0, 2)]
    assert tiny.draw(point=(3, 5)).rows == [(2, 1, 2)]
    assert tiny.draw(real=[(0, 0), (4, 0), (0, 4)]).rows == [(0, 0, 3), (1, 0, 2), (2, 0, 1)]
    assert tiny.draw([(0, 0), (8, 0), (0, 8)]).z == []
    with pytest.raises(ValueError, match="does not draw polygons"):
        tiny.draw(polygon=[(0, 0), (8, 0), (8, 8), (0, 8)])
    with pytest.raises(ValueError, match="does not draw homogeneous"):
        tiny.draw(clip=[(0, 0, 1), (8, 0, 1), (0, 8, 1)])
    with pytest.raises(ValueError, match="exactly one of"):
        tiny.draw(line=[(1, 1), (5, 1)], point=(3, 5))
    with pytest.raises(ValueError, match=r"line\[1\]\[0\] = 99 .* 0 <= x <= 8"):
        tiny.draw(line=[(1, 1), (99, 1)])


def test_registers_are_drawn():
    # Right-angled at (4, 4), two pixels a side, in 1/16: E is 32 times the distance to each side.
    words = [64, 64, 96, 64, 64, 96, 48, 48, 127, 127]
    x, y, at = 4, 4, 7
    long = 32 * (32 - at - at)
    records = guardbit.Model("psp").words(words)
    assert records[0] == ("P", [x | y << 16, long, 32 * at, 32 * at])
    assert [words[0] & 0xFFFF for _, words in records] == [4, 5, 4]


def test_channels_have_a_code_at_each_place(channels):
    assert list(channels.channels.items()) == [("color", ["r", "g"]), ("texcoord", ["u"]), ("face", ["id"])]
    assert guardbit.Model("tiny").channels == {}
    drawing = channels.draw(CORNER, channels=CODES, q=Q)
    assert drawing.rows == [(0, 0, 3), (1, 0, 2), (2, 0, 1)]
    # In half pixels the samples are at 1, 3, 5, and r is x + 2 y there.
    at = [(1, 1), (3, 1), (5, 1), (1, 3), (3, 3), (1, 5)]
    assert drawing.channels == {
        "color": [[x + 2 * y, 8] for x, y in at],
        "texcoord": [[40]] * 6,
        "face": [[3]] * 6,
    }
    assert channels.draw(CORNER, channels=MappingProxyType(CODES), q=Q).channels == drawing.channels
    assert channels.draw(CORNER).channels == {}
    nothing = channels.draw([(0, 0)] * 3, channels=CODES, q=Q)
    assert nothing.zero_area and nothing.channels == {"color": [], "texcoord": [], "face": []}


def test_units_of_channels(channels):
    # 8 bits over 4: 256 is above the range, 384 and more is below 0.
    color = channels.interpolator_walk("color")
    assert color.width == 13
    steps = [(0, 255), (1, 255), (2, 0)]
    assert [color.clock(op, 255 << 4, 1 << 4, 128 << 4)[1] for op, _ in steps] == [out for _, out in steps]
    # 1/w and u/w are read with their fraction.
    assert channels.interpolator_walk().clock(0, 10496, 0, 0) == (10496, 10496)
    assert channels.divide("texcoord", 5084, 10496) == 124
    assert channels.divide("texcoord", 5084 + (1 << 17), 0) == 255
    for call, says in [
        (lambda: channels.interpolator_walk("face"), "face is not walked"),
        (lambda: channels.interpolator_walk("fase"), "no channel \"fase\": the profile has color, texcoord, face"),
        (lambda: channels.divide("color", 1, 1), "color is not divided"),
        (lambda: guardbit.Model("tiny").interpolator_walk(), "1/w is not walked"),
    ]:
        with pytest.raises(ValueError, match=says):
            call()


def test_channels_of_reals_are_rounded_once(channels):
    values = {"color": [[0, 0], [1, 0], [0, 1]], "texcoord": [[0.5]] * 3, "face": [[0], [0], [1.0]]}
    drawing = channels.draw(real=[(0, 0), (4, 0), (0, 4)], channels=values, w=[1, 2, 4])
    # 255 / 8 = 31.875 a half pixel; 127.5 to even is 128.
    assert drawing.channels["color"][:3] == [[32, 32], [96, 32], [159, 32]]
    assert drawing.channels["texcoord"] == [[128]] * 6
    assert drawing.channels["face"] == [[255]] * 6


@pytest.mark.parametrize(
    "change, says",
    [
        ({"q": None}, "texcoord.* each vertex needs its 1/w"),
        ({"q": [255, 0, 64]}, "vertex 1: q = 0: 1 <= q <= 255"),
        ({"q": [255]}, "q: 3 values are needed"),
        ({"q": None, "w": [1, 2, 4]}, "beside vertices, give q"),
        ({"channels": None}, "no channels"),
        ({"channels": CODES | {"face": [[1], [2]]}}, "channels.face: 3 vertices are needed, got 2"),
        ({"channels": CODES | {"face": [[1], [2], []]}}, r"channels.face\[2\]: 0 components, but vertex 0 has 1"),
        ({"channels": CODES | {"face": [[1, 1]] * 3}}, "2 components are given, but the profile has 1"),
        ({"channels": CODES | {"face": [[1], [256], [3]]}}, "vertex 1: id = 256: 0 <= id <= 255"),
        ({"channels": CODES | {"fase": [[1]] * 3}}, "fase.* is unknown"),
        ({"channels": {"color": CODES["color"]}}, "no values for the channel \"texcoord\""),
        ({"vertices": None, "line": [(1, 1), (5, 1)]}, "only triangles"),
        ({"vertices": None, "real": [(0, 0), (4, 0), (0, 4)]}, "beside real, give w"),
    ],
)
def test_wrong_channels_are_refused(channels, change, says):
    with pytest.raises(ValueError, match=says):
        channels.draw(**({"vertices": CORNER, "channels": CODES, "q": Q} | change))
    with pytest.raises(ValueError, match=r"has no \[\[channel\]\]"):
        guardbit.Model("tiny").draw(CORNER, channels=CODES, q=Q)


@pytest.mark.parametrize(
    "call, says",
    [
        (lambda: guardbit.Model("nothing"), "nothing"),
        (lambda: guardbit.Model("tiny").words([1]), "draws primitives"),
        (lambda: guardbit.Model("psp").words([1, 2]), "2 words are given, but this machine takes 10"),
        (lambda: guardbit.Model("tiny").draw([(-1, 0, 0), (8, 0, 7), (0, 8, 7)]), "-1"),
        (lambda: guardbit.Model("tiny").draw([(0, 0, 8), (8, 0, 7), (0, 8, 7)]), r"v\[0\]\[2\] = 8"),
        (lambda: guardbit.Model("tiny").depth_walk().clock(4, 0, 0, 0), "op = 4"),
    ],
)
def test_what_is_wrong_is_said(call, says):
    with pytest.raises(ValueError, match=says):
        call()


def test_wrong_types_are_type_errors():
    with pytest.raises(TypeError):
        guardbit.Model("tiny").draw([(0.5, 0, 0), (8, 0, 7), (0, 8, 7)])


def test_codes_are_integers(channels):
    with pytest.raises(TypeError):
        channels.draw(CORNER, channels=CODES | {"face": [[0.5]] * 3}, q=Q)
    with pytest.raises(TypeError):
        channels.draw(CORNER, channels=[CODES], q=Q)
