"""The mesh formats that are attacked: of each a small sound file. A new format is an entry of FORMATS."""
import base64
import dataclasses
import functools
import json
import pathlib
import re
import struct
import tempfile
import zlib

from hostile import Case, help_text, run_program, run_scene_case, scene_of, sub_commands

VERTICES = [(0, 0, 0), (1, 0, 0.5), (0, 1, 0), (1, 1, 0.25)]
TRIANGLES = [(0, 1, 2), (1, 3, 2)]


@dataclasses.dataclass
class Format:
    suffix: str
    small: bytes  # a sound file of two triangles
    is_text: bool = True


def lines(*rows):
    return ("\n".join(" ".join(map(str, row)) if isinstance(row, tuple) else row for row in rows) + "\n").encode()


def obj():
    return lines("# two triangles", "mtllib none.mtl", "o thing", *(("v", *vertex) for vertex in VERTICES), ("vt", 0, 0),
                 ("vt", 1, 0.5), ("vn", 0, 0, 1), "g left all", "f 1/1/1 2/2/1 3//1", "s 1", "usemtl red", "f 2 4 -2",
                 "l 1 4")


def ply_header(encoding, types):
    return lines("ply", f"format {encoding} 1.0", "comment two triangles", "element vertex 4",
                 *(f"property {types[0]} {axis}" for axis in "xyz"), "element face 2",
                 f"property list {types[1]} {types[2]} vertex_indices", "end_header")


def ply_ascii():
    return ply_header("ascii", ("float", "uchar", "int")) + lines(*VERTICES, *((3, *face) for face in TRIANGLES))


def ply_binary(encoding, order):
    data = b"".join(struct.pack(order + "3f", *vertex) for vertex in VERTICES)
    data += b"".join(struct.pack(order + "B3i", 3, *face) for face in TRIANGLES)
    return ply_header(encoding, ("float", "uchar", "int")) + data


def off():
    return lines("OFF", "# two triangles", "4 2 0", *VERTICES, *((3, *face) for face in TRIANGLES))


def stl_ascii():
    rows = ["solid thing"]
    for face in TRIANGLES:
        rows += ["facet normal 0 0 1", "outer loop", *(("vertex", *VERTICES[i]) for i in face), "endloop", "endfacet"]
    return lines(*rows, "endsolid thing")


def stl_binary():
    data = b"two triangles".ljust(80, b" ") + struct.pack("<I", len(TRIANGLES))
    for face in TRIANGLES:
        data += struct.pack("<12fH", 0, 0, 1, *(x for i in face for x in VERTICES[i]), 0)
    return data


def vtk_ascii():
    return lines("# vtk DataFile Version 3.0", "two triangles", "ASCII", "DATASET POLYDATA", "POINTS 4 float", *VERTICES,
                 "POLYGONS 2 8", *((3, *face) for face in TRIANGLES))


def vtk_binary():
    rows = [b"# vtk DataFile Version 3.0", b"two triangles", b"BINARY", b"DATASET UNSTRUCTURED_GRID", b"POINTS 4 float",
            b"".join(struct.pack(">3f", *vertex) for vertex in VERTICES), b"CELLS 2 8",
            b"".join(struct.pack(">4i", 3, *face) for face in TRIANGLES), b"CELL_TYPES 2", struct.pack(">2i", 5, 5)]
    return b"\n".join(rows) + b"\n"


def vtu(array, attributes="", tail=b""):
    """`array` makes the attributes behind the name of an array and its text, of a format of struct and numbers."""
    def element(kind, form, more, *numbers):
        how, text = array(form, numbers)
        return f'<DataArray type="{kind}" {more} {how}>'.encode() + text + b"</DataArray>"
    rows = [b'<?xml version="1.0"?>', f'<VTKFile type="UnstructuredGrid" {attributes}>'.encode(), b"<UnstructuredGrid>",
            b'<Piece NumberOfPoints="4" NumberOfCells="2">', b"<Points>",
            element("Float32", "f", 'NumberOfComponents="3"', *(x for vertex in VERTICES for x in vertex)), b"</Points>",
            b"<Cells>", element("Int32", "i", 'Name="connectivity"', *(i for face in TRIANGLES for i in face)),
            element("Int32", "i", 'Name="offsets"', 3, 6), element("UInt8", "B", 'Name="types"', 5, 5), b"</Cells>",
            b"</Piece>", b"</UnstructuredGrid>", *([tail] if tail else []), b"</VTKFile>"]
    return b"\n".join(rows) + b"\n"


def vtu_ascii():
    return vtu(lambda _, numbers: ('format="ascii"', " ".join(map(str, numbers)).encode()))


def counted(form, numbers):
    data = struct.pack(f"<{len(numbers)}{form}", *numbers)
    return struct.pack("<I", len(data)) + data


def vtu_compressed():
    def array(form, numbers):
        data = struct.pack(f"<{len(numbers)}{form}", *numbers)
        packed = zlib.compress(data)
        return 'format="binary"', base64.b64encode(struct.pack("<4I", 1, len(data), 0, len(packed))) + base64.b64encode(packed)
    return vtu(array, 'compressor="vtkZLibDataCompressor"')


def vtu_raw():
    data = bytearray()
    def array(form, numbers):
        offset = len(data)
        data.extend(counted(form, numbers))
        return f'format="appended" offset="{offset}"', b""
    vtu(array)
    tail = b'<AppendedData encoding="raw">_' + bytes(data) + b"</AppendedData>"
    data.clear()
    return vtu(array, tail=tail)


FORMATS = {
    "obj": Format("obj", obj()),
    "ply": Format("ply", ply_ascii()),
    "ply, little": Format("ply", ply_binary("binary_little_endian", "<"), is_text=False),
    "ply, big": Format("ply", ply_binary("binary_big_endian", ">"), is_text=False),
    "off": Format("off", off()),
    "stl": Format("stl", stl_ascii()),
    "stl, binary": Format("stl", stl_binary(), is_text=False),
    "vtk": Format("vtk", vtk_ascii()),
    "vtk, binary": Format("vtk", vtk_binary(), is_text=False),
    "vtu": Format("vtu", vtu_ascii()),
    "vtu, compressed": Format("vtu", vtu_compressed()),
    "vtu, appended": Format("vtu", vtu_raw(), is_text=False),
}


@functools.cache
def known_formats():
    """Those of FORMATS that the program says it reads: when it meets one that it does not, and in its help."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "thing.unknown").write_bytes(obj())
        (path / "scene.json").write_text(json.dumps(scene_of({"file": "thing.unknown"})))
        said = run_program(["run", "scene.json", "--out", "out"], path).stderr.decode("utf-8", "replace")
    said += "".join(help_text(command) for command in ("info", "convert") if command in sub_commands())
    return {name: form for name, form in FORMATS.items()
            if form.suffix == "obj" or re.search(rf"\b{form.suffix}\b", said, re.IGNORECASE)}


def mesh_cases(name, suffix, contents, constraints=(), **more):
    """A mesh file for what reads meshes: a scene, and in every other case `pliant info` as well."""
    file = f"thing.{suffix}"
    files = {file: contents} | more.pop("files", {})
    yield run_scene_case(name, scene_of({"file": file}, *constraints), files=files, **more)
    if "info" in sub_commands() and zlib.crc32(name.encode("utf-8", "surrogatepass")) % 2 == 0:
        yield Case(f"{name}, info", ["info", file], files, **({"place": file} | more))
