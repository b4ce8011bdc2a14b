"""Reads and evaluates glTF files, from the specification alone: JSON, buffers, morph targets, linear animation."""
import base64
import json
import struct

import numpy

COMPONENTS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


class Gltf:
    def __init__(self, path):
        data = path.read_bytes()
        if path.suffix == ".glb":
            magic, version, size = struct.unpack("<4sII", data[:12])
            assert (magic, version, size) == (b"glTF", 2, len(data))
            length, kind = struct.unpack("<I4s", data[12:20])
            assert kind == b"JSON" and length % 4 == 0
            self.json = json.loads(data[20:20 + length])
            rest = data[20 + length:]
            length, kind = struct.unpack("<I4s", rest[:8])
            assert kind == b"BIN\0" and len(rest) == 8 + length
            self.buffer = rest[8:]
            assert "uri" not in self.json["buffers"][0]
        else:
            self.json = json.loads(data)
            head, text = self.json["buffers"][0]["uri"].split(",")
            assert head == "data:application/octet-stream;base64"
            self.buffer = base64.b64decode(text, validate=True)
        self.nodes = {node["name"]: node for node in self.json["nodes"]}

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = numpy.dtype(COMPONENTS[accessor["componentType"]])
        width = WIDTHS[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        numbers = numpy.frombuffer(self.buffer, kind, accessor["count"] * width, start)
        numbers = numbers.reshape(-1, width)
        if "min" in accessor:
            numpy.testing.assert_array_equal(numbers.min(0), numpy.float32(accessor["min"]))
            numpy.testing.assert_array_equal(numbers.max(0), numpy.float32(accessor["max"]))
        return numbers

    def view(self, index):
        view = self.json["bufferViews"][index]
        return self.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def primitives(self, name):
        return self.json["meshes"][self.nodes[name]["mesh"]]["primitives"]

    def times(self):
        sampler = self.json["animations"][0]["samplers"][0]
        return self.accessor(sampler["input"])[:, 0].astype(float)

    def weights(self, name, time):
        node = self.json["nodes"].index(self.nodes[name])
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                if channel["target"] != {"node": node, "path": "weights"}:
                    continue
                sampler = animation["samplers"][channel["sampler"]]
                assert sampler["interpolation"] == "LINEAR"
                keys = self.accessor(sampler["input"])[:, 0].astype(float)
                values = self.accessor(sampler["output"]).astype(float).reshape(len(keys), -1)
                return numpy.array([numpy.interp(time, keys, column) for column in values.T])
        return numpy.zeros(0)

    def attribute(self, name, attribute, time, primitive=0):
        """Of a node's mesh at a time, in our axes: +z up."""
        part = self.primitives(name)[primitive]
        result = self.accessor(part["attributes"][attribute]).astype(float)
        targets = part.get("targets", [])
        weights = self.weights(name, time)
        assert len(weights) == len(targets)
        for weight, target in zip(weights, targets):
            if weight:
                result = result + weight * self.accessor(target[attribute])
        x, y, z = result.T
        return numpy.stack([x, -z, y], axis=1)
