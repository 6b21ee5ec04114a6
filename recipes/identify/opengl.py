"""A device for `guardbit identify --device`: it draws each line's triangle with OpenGL, without a window.

It needs EGL and the package moderngl. LIBGL_ALWAYS_SOFTWARE=1 asks Mesa for its software rasterizer.
"""

import json
import struct
import sys
from itertools import groupby

import moderngl

SIZE = 64  # the window of identify: half of it is a power of two, so that the viewport rounds nothing


def runs(line):
    """Maximal runs of covered pixels."""
    for inside, pixels in groupby(range(SIZE), lambda x: line[x] > 0):
        if inside:
            pixels = list(pixels)
            yield pixels[0], pixels[-1] + 1


def main():
    gl = moderngl.create_context(standalone=True, backend="egl")
    print(gl.info["GL_RENDERER"], gl.info["GL_VERSION"], file=sys.stderr)
    program = gl.program(
        vertex_shader="#version 330\nin vec2 p; void main() { gl_Position = vec4(p, 0.0, 1.0); }",
        fragment_shader="#version 330\nout vec4 c; void main() { c = vec4(1.0); }",
    )
    picture = gl.simple_framebuffer((SIZE, SIZE), components=4)
    picture.use()
    vertices = gl.buffer(reserve=24)
    triangle = gl.vertex_array(program, [(vertices, "2f", "p")])
    for line in sys.stdin:
        asked = json.loads(line)
        clip = [value / (SIZE / 2) - 1 for vertex in asked["f"] for value in vertex[:2]]
        vertices.write(struct.pack("6f", *clip))
        picture.clear(0, 0, 0, 0)
        triangle.render(moderngl.TRIANGLES)
        seen = picture.read(components=1)
        rows = [[y, a, b] for y in range(SIZE) for a, b in runs(seen[y * SIZE : (y + 1) * SIZE])]
        print(json.dumps({"id": asked.get("id"), "rows": rows}), flush=True)


if __name__ == "__main__":
    main()
