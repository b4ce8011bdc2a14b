"""PNG files of 8-bit RGB, read and written from the specification alone."""
import struct
import zlib

import numpy

MAGIC = b"\x89PNG\r\n\x1a\n"


def write(pixels):
    """The bytes of a file of these rows from the top, height × width × 3."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    pixels = numpy.asarray(pixels, numpy.uint8)
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return MAGIC + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def read(data):
    """The rows of a file, from the top, height × width × 3."""
    assert data[:8] == MAGIC
    place, body = 8, b""
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        chunk = data[place + 8:place + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", chunk[:10])
            assert (depth, color) == (8, 2)
        if kind == b"IDAT":
            body += chunk
        place += 12 + length
    raw, size = zlib.decompress(body), 3 * width
    rows, before = [], [0] * size
    for y in range(height):
        method, row = raw[y * (size + 1)], list(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for i in range(size):
            left, up, corner = (row[i - 3] if i >= 3 else 0), before[i], (before[i - 3] if i >= 3 else 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda x: abs(guess - x))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[method]) % 256
        rows.append(row)
        before = row
    return numpy.array(rows, numpy.uint8).reshape(height, width, 3)
