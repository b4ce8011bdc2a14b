"""Reads USD text, as much of its grammar as a file of meshes needs, and nothing that is not in it:

    file      "#usda 1.0" metadata? prim*
    prim      "def" type string metadata? "{" (attribute | prim)* "}"
    metadata  "(" (["prepend"] name "=" value | type name "=" value)* ")"
    attribute ["uniform"] type ["[]"] name [["." ("timeSamples" | "connect")] "=" value metadata?]
    value     number | string | "<" path ">" | "@" file "@" | "@@@" file "@@@" | "[" items "]" | "(" items ")" | "{" time ":" value, ... "}" | "{" type name "=" value "}"
"""
import re

TOKEN = re.compile(r'''\s*(?:(?P<string>"(?:[^"\\\n]|\\.)*")
                         |(?P<path></[A-Za-z0-9_/]*(?:\.[A-Za-z:]+)?>)
                         |(?P<asset>@@@[^\n]+?@@@|@[^@\n]+@)
                         |(?P<number>-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
                         |(?P<name>[A-Za-z_][A-Za-z0-9_]*(?::[A-Za-z_][A-Za-z0-9_]*)*(?:\[\])?)
                         |(?P<sign>[][(){}=,:.]))''', re.VERBOSE)


class Prim:
    def __init__(self, kind, name):
        self.kind, self.name = kind, name
        self.metadata, self.attributes, self.types, self.samples = {}, {}, {}, {}
        self.interpolation, self.uniform, self.connections = {}, set(), {}
        self.children = {}

    def find(self, *names):
        prim = self
        for name in names:
            prim = prim.children[name]
        return prim


class Reader:
    def __init__(self, text):
        head, text = text.split("\n", 1)
        assert head == "#usda 1.0", head
        self.tokens, place = [], 0
        text = text.rstrip()
        while place < len(text):
            match = TOKEN.match(text, place)
            assert match, text[place:place + 40]
            self.tokens.append((match.lastgroup, match.group(match.lastgroup)))
            place = match.end()
        self.place = 0

    def peek(self):
        return self.tokens[self.place][1] if self.place < len(self.tokens) else None

    def take(self, expected=None, kind=None):
        found, text = self.tokens[self.place]
        assert expected is None or text == expected, (text, expected)
        assert kind is None or found == kind, (text, kind)
        self.place += 1
        return text

    def string(self):
        text = self.take(kind="string")[1:-1]
        return re.sub(r"\\(.)", r"\1", text)

    def file(self):
        root = Prim(None, None)
        root.metadata = self.metadata()
        while self.peek():
            self.prim(root)
        return root

    def metadata(self):
        values = {}
        if self.peek() != "(":
            return values
        self.take("(")
        while self.peek() != ")":
            if self.peek() == "prepend":
                self.take()
            name = self.take(kind="name")
            self.take("=")
            values[name] = self.value()
        self.take(")")
        return values

    def prim(self, parent):
        self.take("def")
        prim = Prim(self.take(kind="name"), self.string())
        assert re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", prim.name), prim.name
        assert prim.name not in parent.children, prim.name
        parent.children[prim.name] = prim
        prim.metadata = self.metadata()
        self.take("{")
        while self.peek() != "}":
            if self.peek() == "def":
                self.prim(prim)
            else:
                self.attribute(prim)
        self.take("}")

    def attribute(self, prim):
        is_uniform = self.peek() == "uniform"
        if is_uniform:
            self.take()
        kind = self.take(kind="name")
        name = self.take(kind="name")
        assert name not in prim.types or prim.types[name] == kind
        prim.types[name] = kind
        if is_uniform:
            prim.uniform.add(name)
        if self.peek() == ".":
            self.take(".")
            what = self.take(kind="name")
            self.take("=")
            if what == "connect":
                prim.connections[name] = self.value()
            else:
                assert what == "timeSamples", what
                prim.samples[name] = self.time_samples()
        elif self.peek() == "=":
            self.take("=")
            prim.attributes[name] = self.value()
        prim.interpolation[name] = self.metadata().get("interpolation")

    def time_samples(self):
        samples = {}
        self.take("{")
        while self.peek() != "}":
            time = float(self.take(kind="number"))
            assert not samples or time > max(samples)
            self.take(":")
            samples[time] = self.value()
            if self.peek() == ",":
                self.take(",")
        self.take("}")
        return samples

    def items(self, end):
        values = []
        while self.peek() != end:
            values.append(self.value())
            if self.peek() == ",":
                self.take(",")
            else:
                assert self.peek() == end, self.peek()
        self.take(end)
        return values

    def value(self):
        kind, text = self.tokens[self.place]
        if kind == "string":
            return self.string()
        if kind == "number":
            self.place += 1
            return float(text)
        if kind in ("path", "asset"):
            return self.take().strip("<>@")
        self.take()
        if text == "[":
            return self.items("]")
        if text == "(":
            return tuple(self.items(")"))
        assert text == "{", text
        values = {}
        while self.peek() != "}":
            self.take(kind="name")  # the type
            name = self.take(kind="name")
            self.take("=")
            values[name] = self.value()
        self.take("}")
        return values


def read(path):
    return Reader(path.read_text(encoding="utf-8")).file()
