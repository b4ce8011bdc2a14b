"""Reads .pvd and .vtu files by the standard library and numpy alone: XML, base64 and zlib, as VTK describes them."""
import base64
import xml.etree.ElementTree
import zlib

import numpy


def collection(path):
    """(time, file) of each frame of a .pvd file."""
    root = xml.etree.ElementTree.parse(path).getroot()
    assert (root.tag, root.get("type")) == ("VTKFile", "Collection")
    return [(float(each.get("timestep")), path.parent / each.get("file")) for each in root.find("Collection")]


def numbers(array):
    """Of a DataArray in base64, compressed, with counts of 8 bytes."""
    assert array.get("format") == "binary"
    text = array.text.strip()
    blocks = int(numpy.frombuffer(base64.b64decode(text[:12])[:8], "<u8")[0])
    head_length = -(-8 * (3 + blocks) // 3) * 4
    head = numpy.frombuffer(base64.b64decode(text[:head_length]), "<u8")
    data = base64.b64decode(text[head_length:])
    assert len(head) == 3 + blocks and sum(head[3:]) == len(data)
    unpacked = b""
    for i, size in enumerate(map(int, head[3:])):
        block = zlib.decompress(data[:size])
        assert len(block) == (head[2] if i + 1 == blocks and head[2] else head[1])
        data = data[size:]
        unpacked += block
    kind = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}[array.get("type")]
    values = numpy.frombuffer(unpacked, kind)
    components = int(array.get("NumberOfComponents"))
    return values.reshape(-1, components) if components > 1 else values


class Grid:
    """points, point_data by name, and cells as (type, corners)."""

    def __init__(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        assert root.attrib == {"type": "UnstructuredGrid", "version": "1.0", "byte_order": "LittleEndian",
                               "header_type": "UInt64", "compressor": "vtkZLibDataCompressor"}
        (piece,) = root.find("UnstructuredGrid")
        self.points = numbers(piece.find("Points")[0])
        assert len(self.points) == int(piece.get("NumberOfPoints"))
        self.point_data = {array.get("Name"): numbers(array) for array in piece.find("PointData")}
        cells = {array.get("Name"): numbers(array) for array in piece.find("Cells")}
        ends = cells["offsets"]
        assert len(ends) == len(cells["types"]) == int(piece.get("NumberOfCells"))
        corners = numpy.split(cells["connectivity"], ends[:-1]) if len(ends) else []
        self.cells = [(int(kind), tuple(map(int, each))) for kind, each in zip(cells["types"], corners)]
