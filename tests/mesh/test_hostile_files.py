#!/usr/bin/env python3
"""Files made to exhaust memory or time: `pliant info` ends with code 0 or 2, one line of error, in less than ten times
the file's size and a constant. The sizes are a few MB, so that the constant does not hide what grows."""
import base64
import itertools
import os
import struct
import subprocess
import sys
import tempfile
import time
import zlib

PLIANT = os.environ["PLIANT"]
SIZE = 4_000_000
CONSTANT = 40_000_000  # the program itself, its libraries, blocks and passes

OBJ_VERTICES = b"".join(b"v %d %d %d\n" % (i, i * i % 7, i % 3) for i in range(9))


def names(count):
    letters = itertools.product(b"abcdefghijklmnopqrstuvwxyz", repeat=5)
    return [bytes(word) for word in itertools.islice(letters, count)]


def repeated(head, unit, tail=b""):
    return head + unit * (SIZE // len(unit)) + tail


def obj_files():
    yield "vertices", repeated(b"", b"v 0 0 0\n")
    yield "one_color", repeated(b"v 0 0 0 1 1 1 1\n", b"v 0 0 0\n")
    yield "faces", repeated(OBJ_VERTICES, b"f 1 2 3\n")
    yield "faces_before_vertices", repeated(b"", b"f 1 2 3\n", OBJ_VERTICES)
    yield "polygons", repeated(OBJ_VERTICES, b"f 1 2 3 4 5 6 7 8 9\n")
    yield "one_texture", repeated(OBJ_VERTICES + b"vt 0\n", b"f 1 2 3 4 5 6 7 8 9\n", b"f 1/1 2 3\n")
    yield "lines", repeated(OBJ_VERTICES, b"l 1 2\n")
    yield "long_line", repeated(OBJ_VERTICES + b"l 3", b" 1 2")
    yield "long_face", b"v 0 0 0\n" * (SIZE // 20) + b"f" + b"".join(b" %d" % i for i in range(1, SIZE // 20))
    yield "groups", repeated(OBJ_VERTICES + b"f 1 2 3\n", b"g a\n")
    yield "objects", repeated(OBJ_VERTICES, b"o a\nf 1 2 3\no b\nf 1 3 2\n")
    yield "group_names", OBJ_VERTICES + b"g " + b" ".join(names(SIZE // 6)) + b"\nf 1 2 3\n"
    yield "many_groups", OBJ_VERTICES + b"".join(b"o %s\nf 1 2 3\n" % n for n in names(SIZE // 16))
    yield "groups_of_all", OBJ_VERTICES + b"g " + b" ".join(names(250)) + b"\n" + b"f 1 2 3\n" * (SIZE // 8)
    yield "libraries", OBJ_VERTICES + b"".join(b"mtllib %s\n" % n for n in names(SIZE // 13))
    yield "one_word", repeated(OBJ_VERTICES + b"g ", b"a")
    yield "long_name", repeated(OBJ_VERTICES + b"o ", b"abc ", b"\nf 1 2 3\n")
    yield "comment", repeated(OBJ_VERTICES + b"#", b"a")
    yield "continued", repeated(OBJ_VERTICES, b"\\\n")
    yield "nuls", bytes(SIZE)


def ply(elements, body, encoding=b"binary_little_endian"):
    return b"ply\nformat %s 1.0\n%send_header\n%s" % (encoding, elements, body)


def ply_files():
    nine = b"element vertex 9\nproperty char x\nproperty char y\nproperty char z\n"
    corners = bytes(range(27))
    bytes_list = b"element face %d\nproperty list uchar uchar vertex_indices\n"
    short_list = b"element face %d\nproperty list uchar short vertex_indices\n"
    yield "byte_faces", ply(nine + bytes_list % (SIZE // 4), corners + b"\x03\0\1\2" * (SIZE // 4))
    row = b"\x09\0\1\2\3\4\5\6\7\x08"
    yield "byte_polygons", ply(nine + bytes_list % (SIZE // 10), corners + row * (SIZE // 10))
    row = b"\x09" + struct.pack("<9h", *range(9))
    yield "short_polygons", ply(nine + short_list % (SIZE // 19), corners + row * (SIZE // 19))
    xyz = b"element vertex %d\nproperty char x\nproperty char y\nproperty char z\n"
    yield "byte_vertices", ply(xyz % (SIZE // 3), bytes(SIZE // 3 * 3))
    maps = b"".join(b"property char p%d\n" % i for i in range(97))
    yield "maps", ply(xyz % (SIZE // 100) + maps, bytes(SIZE))
    yield "maps_promised", ply(xyz % (SIZE // 2) + maps, b"0 " * (SIZE // 2), b"ascii")
    yield "properties", ply(xyz % 1 + b"".join(b"property char %s\n" % n for n in names(SIZE // 20)), b"0", b"ascii")
    edges = b"element edge %d\nproperty uchar vertex1\nproperty uchar vertex2\n" % (SIZE // 2)
    yield "edges", ply(nine + edges, corners + b"\0\1" * (SIZE // 2))
    strip = b"element tristrips 1\nproperty list int uchar vertex_indices\n"
    yield "strip", ply(nine + strip, corners + struct.pack("<i", SIZE) + (b"\0\1\2" * SIZE)[:SIZE])
    yield "promised_vertices", ply(xyz % 2_000_000_000, b"0 0 0\n")
    yield "promised_list", ply(nine + b"element face 1\nproperty list uint int vertex_indices\n", corners + b"\xff" * 99)


def other_files():
    points = b"0 0 0\n" * 9
    yield "faces.off", b"OFF 9 %d 0\n" % (SIZE // 8) + points + b"3 0 1 2\n" * (SIZE // 8)
    yield "polygons.off", b"OFF 9 %d 0\n" % (SIZE // 20) + points + b"9 0 1 2 3 4 5 6 7 8\n" * (SIZE // 20)
    yield "colors.off", b"COFF\n%d 0 0\n" % (SIZE // 14) + b"0 0 0 0 0 0 0\n" * (SIZE // 14)
    yield "promised.off", b"OFF 2000000000 2000000000 0\n0 0 0\n"
    count = SIZE // 50
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *[9 * i + k for k in range(9)], 0) for i in range(count))
    yield "distinct.stl", bytes(80) + struct.pack("<I", count) + facets
    yield "one_point.stl", b"solid".ljust(80) + struct.pack("<I", count) + bytes(50 * count)
    yield "promised.stl", bytes(80) + struct.pack("<I", 4_000_000_000) + bytes(500)
    head = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n"
    yield "nodes.msh", head % (SIZE // 8) + b"".join(b"%d 0 0 0\n" % (9 - i % 10) for i in range(SIZE // 8))
    four = b"1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n%d\n"
    rows = b"1 4 0 1 2 3 4\n" * (SIZE // 14)
    yield "tetrahedra.msh", head % 4 + four % (SIZE // 14) + rows + b"$EndElements\n"
    yield "promised.msh", head % 2_000_000_000 + b"1 0 0 0\n"
    head = b"MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n"
    yield "vertices.mesh", head % (SIZE // 8) + b"0 0 0 0\n" * (SIZE // 8) + b"End\n"
    yield "references.mesh", head % (SIZE // 10) + b"".join(b"0 0 0 %d\n" % i for i in range(SIZE // 10)) + b"End\n"
    four = head % 4 + b"0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    rows = b"1 2 3 4 7\n" * (SIZE // 10)
    yield "tetrahedra.mesh", four + b"Tetrahedra\n%d\n" % (SIZE // 10) + rows + b"End\n"
    rows = b"".join(b"1 2 3 %d\n" % i for i in range(SIZE // 12))
    yield "faces.mesh", four + b"Triangles\n%d\n" % (SIZE // 12) + rows + b"End\n"
    yield "promised.mesh", head % 2_000_000_000 + b"0 0 0 0\n"
    yield "skipped.mesh", repeated(four + b"Corners\n", b"1\n")
    yield "points.node", b"%d 3 100 1\n" % (SIZE // 6) + b"0 " * (SIZE // 2)
    yield "elements.ele", b"2000000000 4 0\n0 0 1 2 3\n"


def vtu(points, cells, arrays, attributes="", tail=b""):
    """`arrays` are (type, attributes, text): of the points, then of the cells."""
    elements = [b'<DataArray type="%s" %s>%s</DataArray>\n' % array for array in arrays]
    return (b'<VTKFile type="UnstructuredGrid" %s>\n<UnstructuredGrid>\n' % attributes.encode()
            + b'<Piece NumberOfPoints="%d" NumberOfCells="%d">\n' % (points, cells)
            + b"<Points>" + elements[0] + b"</Points><Cells>" + b"".join(elements[1:4]) + b"</Cells><PointData>"
            + b"".join(elements[4:]) + b"</PointData></Piece></UnstructuredGrid>" + tail + b"</VTKFile>\n")


NAMES = [b'NumberOfComponents="3"', b'Name="connectivity"', b'Name="offsets"', b'Name="types"']


def ascii_vtu(points, cells, *texts):
    kinds = [b"Float32", b"Int64", b"Int64", b"UInt8"]
    return vtu(points, cells, [(kind, name + b' format="ascii"', text) for kind, name, text in zip(kinds, NAMES, texts)])


def raw_vtu(points, cells, *arrays):
    """`arrays` are bytes of numbers of one byte each, behind each other."""
    data, elements = b"", []
    for i, array in enumerate(arrays):
        name = NAMES[i] if i < 4 else b'Name="map%d"' % i
        elements.append((b"UInt8", name + b' format="appended" offset="%d"' % len(data), b""))
        data += struct.pack("<I", len(array)) + array
    return vtu(points, cells, elements, tail=b'<AppendedData encoding="raw">_' + data + b"</AppendedData>")


def packed_vtu(zeros):
    """Points that are compressed zeros."""
    block = 1 << 20
    blocks = [zlib.compress(bytes(block))] * (zeros // block)
    text = base64.b64encode(struct.pack(f"<{3 + len(blocks)}I", len(blocks), block, 0, *map(len, blocks)))
    text += base64.b64encode(b"".join(blocks))
    none = (b"Int64", b'Name="none" format="ascii"', b"")
    return vtu(zeros // 12, 0, [(b"Float32", NAMES[0] + b' format="binary"', text), none, none, none],
               'compressor="vtkZLibDataCompressor"')


def vtk_files():
    four = b"0 0 0 1 0 0 0 1 0 0 0 1 "
    yield "points.vtu", ascii_vtu(SIZE // 6, 0, b"0 0 0 " * (SIZE // 6), b"", b"", b"")
    count = SIZE // 16
    yield "faces.vtu", ascii_vtu(4, count, four, b"0 1 2 " * count, b"".join(b"%d " % (3 * i + 3) for i in range(count)),
                                 b"5 " * count)
    yield "one_strip.vtu", ascii_vtu(4, 1, four, b"0 1 2 " * (SIZE // 6), b"%d" % (SIZE // 6 * 3), b"6")
    yield "byte_points.vtu", raw_vtu(SIZE // 3, 0, bytes(SIZE // 3 * 3), b"", b"", b"")
    yield "byte_maps.vtu", raw_vtu(SIZE // 8, 0, bytes(SIZE // 8 * 3), b"", b"", b"", *[bytes(SIZE // 8)] * 5)
    yield "byte_corners.vtu", raw_vtu(4, 1, bytes(12), bytes(range(4)) * (SIZE // 4), b"\3", b"\5")
    yield "promised.vtu", ascii_vtu(2_000_000_000, 2_000_000_000, b"0", b"0", b"0", b"0")
    yield "tags.vtu", repeated(b"<VTKFile>", b"<a/>", b"</VTKFile>")
    yield "attributes.vtu", repeated(b"<VTKFile ", b"a='' ", b"></VTKFile>")
    yield "deep.vtu", repeated(b"", b"<a>")
    yield "text.vtu", repeated(b"<VTKFile>", b"a", b"</VTKFile>")
    count = SIZE // 8
    data = struct.pack("<I", 3 * count) + bytes(3 * count) + struct.pack("<I", count) + bytes(count)
    at = b' format="appended" offset="%d"'
    shared = [(b"UInt8", NAMES[0] + at % 0, b"")] + [(b"UInt8", b'Name="none"' + at % 0, b"")] * 3
    shared += [(b"UInt8", b'Name="%s"' % name + at % (3 * count + 4), b"") for name in names(SIZE // 200)]
    yield "shared.vtu", vtu(count, 0, shared, tail=b'<AppendedData encoding="raw">_' + data + b"</AppendedData>")
    yield "bomb.vtu", packed_vtu(1 << 31)
    head = b"# vtk DataFile Version 3.0\n\n%s\nDATASET %s\n"
    grid, surface = head % (b"ASCII", b"UNSTRUCTURED_GRID"), head % (b"BINARY", b"POLYDATA")
    yield "points.vtk", grid + b"POINTS %d float\n" % (SIZE // 6) + b"0 0 0\n" * (SIZE // 6)
    points = b"POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
    count = SIZE // 10
    yield "cells.vtk", (grid + points + b"CELLS %d %d\n" % (count, 4 * count) + b"3 0 1 2\n" * count
                        + b"CELL_TYPES %d\n" % count + b"5\n" * count)
    binary = surface + b"POINTS 4 char\n" + bytes([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]) + b"\n"
    row = struct.pack(">4i", 3, 0, 1, 2)
    count = SIZE // 16
    yield "polygons.vtk", binary + b"POLYGONS %d %d\n" % (count, 4 * count) + row * count
    count = SIZE // 3
    yield "strip.vtk", (binary + b"TRIANGLE_STRIPS 2 %d\nOFFSETS int\n" % count + struct.pack(">2i", 0, count)
                        + b"\nCONNECTIVITY char\n" + b"\0\1\2" * (count // 3) + b"\0\1\2"[:count % 3])
    yield "promised.vtk", surface + b"POINTS 2000000000 float\n" + bytes(999)
    yield "field.vtk", surface + b"FIELD f 1\na 1000000000 1000000000 double\n" + bytes(999)
    yield "one_word.vtk", repeated(grid, b"a")
    yield "title.vtk", repeated(b"# vtk DataFile Version 3.0\n", b"a")


def all_files():
    for name, content in obj_files():
        yield name + ".obj", content
    for name, content in ply_files():
        yield name + ".ply", content
    yield from other_files()
    yield from vtk_files()


def measure(path):
    """Prints exit code, peak memory in bytes and seconds, then the messages. In a process of its own: what it starts
    begins with its memory."""
    start = time.monotonic()
    process = subprocess.Popen([PLIANT, "info", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    messages = process.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    print(process.returncode, usage.ru_maxrss * 1024, time.monotonic() - start)
    print(messages, end="")


def run(path):
    """Exit code, messages, peak memory in bytes, seconds."""
    measured = subprocess.run([sys.executable, __file__, "--measure", path], stdout=subprocess.PIPE, check=True)
    first, _, messages = measured.stdout.decode().partition("\n")
    code, memory, seconds = first.split()
    return int(code), messages, int(memory), float(seconds)


def main():
    failures = []
    with open(os.environ["PLIANT"], "rb") as program:
        if b"__asan_init" in program.read():
            print("skipped: the memory of a program with a sanitizer is not its own")
            return 77
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "elements.node"), "wb") as file:
            file.write(b"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n")
        with open(os.path.join(folder, "points.ele"), "wb") as file:
            file.write(b"1 4 0\n0 0 1 2 3\n")
        for name, content in all_files():
            path = os.path.join(folder, name)
            with open(path, "wb") as file:
                file.write(content)
            code, messages, memory, seconds = run(path)
            is_error = code == 2 and messages.count("\n") == 1 and path.rsplit(".", 1)[0] in messages
            if not (code == 0 and messages == "") and not is_error:
                failures.append(f"{name}: exit code {code}: {messages[:300]}")
            if len(messages) > len(path) + 300:
                failures.append(f"{name}: a message of {len(messages)} characters")
            if memory > 10 * len(content) + CONSTANT:
                failures.append(f"{name}: {memory / 1e6:.0f} MB for a file of {len(content) / 1e6:.1f} MB")
            if seconds > 30:  # 10 on a machine with nothing else to do
                failures.append(f"{name}: {seconds:.1f} s")
            if "-v" in sys.argv:
                print(f"{name:28} {memory / 1e6:7.1f} MB {seconds:6.2f} s  {code} {messages[-150:].strip()}")
            os.remove(path)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(measure(sys.argv[2]) if sys.argv[1:2] == ["--measure"] else main())
