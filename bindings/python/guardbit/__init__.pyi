from typing import Mapping, Sequence

Vertex = tuple[int, int, int]

class Drawing:
    """What drawing a triangle gave."""

    rows: list[tuple[int, int, int]]
    """Covered runs y, x0, x1, half open, in the order of y then x."""
    z: list[int]
    """Depth of each covered sample, run by run."""
    channels: dict[str, list[list[int]]]
    """Codes by the names of the channels, run by run: the components at each place, in the order of pixel,
    then sample, as `eval` has them. Empty if no channels were given."""
    setup: list[tuple[str, int]]
    """Set-up words by the names of their columns, reduced to their widths."""
    zero_area: bool

class Model:
    """A profile ready to draw."""

    def __init__(self, name: str) -> None:
        """Takes a built-in name or the path of a TOML file; ValueError if it is refused."""
    @property
    def name(self) -> str: ...
    @property
    def channels(self) -> dict[str, list[str]]:
        """Names of the components by the names of the channels, in the order of the profile."""
    def draw(
        self,
        vertices: Sequence[Sequence[int]] | None = None,
        *,
        real: Sequence[Sequence[float]] | None = None,
        line: Sequence[Sequence[int]] | None = None,
        point: Sequence[int] | None = None,
        polygon: Sequence[Sequence[int]] | None = None,
        clip: Sequence[Sequence[int]] | None = None,
        channels: Mapping[str, Sequence[Sequence[float]]] | None = None,
        q: Sequence[int] | None = None,
        w: Sequence[float] | None = None,
    ) -> Drawing:
        """Draws one primitive; exactly one of the first six arguments is given.

        vertices: a triangle, x, y on the profile's input lattice and z in depth codes (optional, and
        ignored without depth). real: the same in pixels, snapped by the profile. line: two ends x, y.
        point: x, y. polygon: three or more vertices x, y or x, y, z. clip: three homogeneous vertices
        X, Y, W or X, Y, Z, W. ValueError if a coordinate is outside its field, or if the machine does
        not draw this kind.

        A triangle of a profile with channels may bring their values, in the form of `eval`: channels has,
        by name, three lists, the components of each vertex. Beside vertices they are codes (int), and q
        has three codes of 1/w. Beside real they are numbers (float), and w has three distances from the
        eye. q or w is needed if a channel is corrected for perspective. Every channel is given, or none.
        ValueError if a value does not go with the profile; the message says why, and calls vertices `v`
        and real `f`, as `eval` does."""
    def words(self, words: Sequence[int]) -> list[tuple[str, list[int]]]:
        """Draws what registers say, on a profile that begins there: 32-bit words in the profile's order;
        each record's letter and words in the order that the hardware draws. ValueError for another number
        of words, or more than 4194304 records."""
    def depth_walk(self) -> Walk: ...
    def edge_walk(self) -> Walk: ...
    def interpolator_walk(self, channel: str | None = None) -> Walk:
        """The walk of a component of a channel, or of the component over w; of 1/w without a name. Its
        read-out has the bits of its word: a negative one is 2^bits more."""
    def divide(self, channel: str, acc: int, acc_w: int) -> int:
        """The code for the accumulators of u/w and 1/w, each taken mod 2^width."""

class Walk:
    """An accumulator with its read-out, or an edge word with its sign test, all zeros at first."""

    @property
    def width(self) -> int: ...
    def clock(self, op: int, init: int, dx: int, dy: int) -> tuple[int, int]:
        """One clock edge: op 0 loads init, 1 adds dx, 2 adds dy, 3 holds. Returns the word after it
        and its read-out, or 1 for inside. Words are taken mod 2^width."""
