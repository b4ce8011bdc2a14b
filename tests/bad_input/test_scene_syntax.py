"""Scene files that are no sound JSON, or JSON of the strangest kind."""
import random

import hostile
from hostile import DONE, INPUT, JSON_MEMORY_FACTOR, HostileTest, run_scene_case

SMALL = """{
  "pliant": 1, "steps": 1,
  "bodies": [
    { "name": "a", "mesh": { "vertices": [[0, 0, 0], [1, 0, 0.5]], "edges": [[0, 1]] }, "mass": { "total": 1e-1 },
      "constraints": [{ "type": "edge_spring", "stiffness": 2e1 }] }
  ]
}
"""

# Stand where the small scene has its stiffness: (name, text, what the error says; empty: legal).
SPELLINGS = [
    ("NaN", "NaN", r"fix the JSON"),
    ("nan", "nan", r"fix the JSON"),
    ("Infinity", "Infinity", r"fix the JSON"),
    ("-Infinity", "-Infinity", r"fix the JSON"),
    ("inf", "inf", r"fix the JSON"),
    ("too large", "1e999", r"stiffness: .*beyond"),
    ("too large, negative", "-1e999", r"stiffness: .*beyond"),
    ("a long way too large", "1" + "0" * 400, r"stiffness: .*beyond"),
    ("a huge exponent", "1e99999999999999999999", r"stiffness: .*beyond"),
    ("a tiny exponent", "1e-99999999999999999999", r"stiffness"),
    ("denormal", "1e-310", r""),
    ("the smallest", "4.9406564584124654e-324", r""),
    ("too small", "1e-400", r"stiffness"),
    ("-0", "-0", r"stiffness"),
    ("-0.0", "-0.0", r"stiffness"),
    ("+1", "+1", r"fix the JSON"),
    ("0x10", "0x10", r"fix the JSON"),
    ("010", "010", r"fix the JSON"),
    ("1_000", "1_000", r"fix the JSON"),
    ("1.", "1.", r"fix the JSON"),
    (".5", ".5", r"fix the JSON"),
    ("1e", "1e", r"fix the JSON"),
    ("1e+", "1e+", r"fix the JSON"),
    ("a decimal comma", "1,5", r"fix the JSON"),
    ("a fraction", "1/2", r"fix the JSON"),
    ("with a unit", "20 N", r"fix the JSON"),
    ("two numbers", "1 2", r"fix the JSON"),
    ("True", "True", r"fix the JSON"),
    ("undefined", "undefined", r"fix the JSON"),
    ("Arabic digits", "٢٠", r"fix the JSON"),
    ("a dash", "–20", r"fix the JSON"),
    ("quoted", '"20"', r"stiffness: found a string"),
    ("single quotes", "'20'", r"fix the JSON"),
    ("nothing", "", r"fix the JSON"),
    ("2^63", "9223372036854775808", r""),
    ("a million digits after the point", "1." + "3" * 1000000, r""),
]

# The whole file.
TEXTS = [
    ("empty", b""), ("a blank", b" "), ("only blanks", b" \n\t\r\n" * 100), ("only a NUL", b"\0"),
    ("only a BOM", b"\xef\xbb\xbf"), ("half a BOM", b"\xef\xbb" + SMALL.encode()), ("a UTF-16 BOM", b"\xff\xfe"),
    ("UTF-16, little", SMALL.encode("utf-16-le")), ("UTF-16 with BOM", SMALL.encode("utf-16")),
    ("UTF-16, big", SMALL.encode("utf-16-be")), ("UTF-32", SMALL.encode("utf-32")),
    ("two BOMs", b"\xef\xbb\xbf" * 2 + SMALL.encode()),
    ("a NUL behind", SMALL.encode() + b"\0"), ("a scene behind", SMALL.encode() * 2),
    ("a brace behind", SMALL.encode() + b"}"), ("a comma behind", SMALL.encode() + b","),
    ("null", b"null"), ("a number", b"1"), ("a text", b'"pliant"'), ("a list", b"[]"), ("a list of scenes",
    b"[" + SMALL.encode() + b"]"), ("an open text", b'"'), ("an open escape", b'"\\'), ("an open \\u", b'"\\u12'),
    ("a lone surrogate", b'{"pliant": 1, "name": "\\ud800", "bodies": []}'),
    ("surrogates the wrong way round", b'{"name": "\\udc00\\ud800"}'),
    ("CBOR", b"\xd9\xd9\xf7\xa1\x66pliant\x01"), ("BSON", b"\x16\0\0\0\x10pliant\0\x01\0\0\0\0"),
    ("gzip", b"\x1f\x8b\x08\0\0\0\0\0\0\x03" + bytes(range(256))), ("every byte", bytes(range(256))),
    ("XML", b"<?xml version='1.0'?><scene/>"), ("YAML", b"pliant: 1\nbodies: []\n"), ("an OBJ", b"v 0 0 0\n"),
    ("escape sequences", b"\x1b[2J\x1b[31m{}"), ("a bell as a key", b'{"\\u0007\\u001b[31m": 1}'),
    ("a newline as a key", b'{"pliant": 1, "a\\nb\\r\\u2028c": 1}'),
    ("C1 controls as a key", b'{"pliant": 1, "\\u0085\\u009b31m": 1}'),
    ("right to left as a key", '{"pliant": 1, "\u202egnp.exe": 1}'.encode()),
    ("a long key", b'{"pliant": 1, "' + b"k" * 100000 + b'": 1}'),
    ("a long key of long characters", b'{"pliant": 1, "' + "\U0001f9f5".encode() * 50000 + b'": 1}'),
    ("a long key of controls", b'{"pliant": 1, "' + b"\\u0001" * 50000 + b'": 1}'),
    ("long keys inside each other", b'{"' + b'k' * 150 + b'": ' + (b'{"' + b"k" * 150 + b'": ') * 60 + b"1" + b"}" * 61),
    ("a bad escape", b'{"\\x41": 1}'), ("a raw newline in a text", b'{"a\nb": 1}'),
    ("a raw tab in a text", b'{"a\tb": 1}'), ("invalid UTF-8 in a key", b'{"\xff\xfe": 1}'),
    ("overlong UTF-8", b'{"\xc0\xaf": 1}'), ("a surrogate in UTF-8", b'{"\xed\xa0\x80": 1}'),
    ("past the last character", b'{"\xf5\x80\x80\x80": 1}'), ("half a character", b'{"\xe2\x82'),
    ("comments", b'{"pliant": 1, /* a comment */ "bodies": []}'), ("a line comment", b'// one\n{"pliant": 1}'),
    ("a # comment", b'# one\n{"pliant": 1}'), ("a comma too many", b'{"pliant": 1, "bodies": [],}'),
    ("a comma too many in a list", b'{"pliant": 1, "bodies": [1,]}'), ("keys without quotes", b"{pliant: 1}"),
    ("a number as a key", b'{1: 1}'), ("semicolons", b'{"pliant": 1; "bodies": []}'), ("equals", b'{"pliant" = 1}'),
    ("a key twice", b'{"pliant": 1, "pliant": 1, "bodies": []}'),
    ("a key twice, spelt otherwise", b'{"pliant": 1, "\\u0070liant": 1, "bodies": []}'),
]
SOUND = [("BOM", b"\xef\xbb\xbf" + SMALL.encode()), ("CRLF", SMALL.replace("\n", "\r\n").encode()),
         ("CR", SMALL.replace("\n", "\r").encode()), ("one line", SMALL.replace("\n", " ").encode()),
         ("no line end", SMALL.strip().encode()), ("many blanks", SMALL.replace(" ", " \t" * 100).encode()),
         ("escaped keys", SMALL.replace("pliant", "\\u0070liant").encode())]

BRACKETS = 100000
DEEP = [("[", "["), ("{", '{"a":'), ("[{", '[{"a":'), ("bodies", '{"pliant": 1, "bodies": [')]

# Ways to fill five megabytes, where a list of numbers, a text or nothing is looked for.
BIG = [
    ("a key of 5 MB", lambda: b'{"pliant": 1, "' + b"k" * 5000000 + b'": 1}'),
    ("a text of 5 MB", lambda: b'{"pliant": 1, "name": "' + b"k" * 5000000 + b'", "bodies": []}'),
    ("5 MB of digits", lambda: b'{"pliant": ' + b"9" * 5000000 + b"}"),
    ("5 MB of digits after the point", lambda: b'{"pliant": 1.' + b"9" * 5000000 + b"}"),
    ("5 MB of blanks", lambda: b" " * 5000000),
    ("5 MB of line ends", lambda: b"\n" * 5000000 + b"{"),
    ("5 MB that are no JSON", lambda: b"x" * 5000000),
    ("5 MB of NULs", lambda: b"\0" * 5000000),
    ("5 MB of zeros", lambda: b'{"pliant": 1, "bodies": [' + b"0," * 2500000 + b"0]}"),
    ("5 MB of empty lists", lambda: b'{"pliant": 1, "bodies": [' + b"[]," * 1700000 + b"0]}"),
    ("5 MB of empty objects", lambda: b'{"pliant": 1, "bodies": [' + b"{}," * 1700000 + b"0]}"),
    ("5 MB of empty texts", lambda: b'{"pliant": 1, "bodies": [' + b'"",' * 1700000 + b"0]}"),
    ("5 MB of nulls", lambda: b'{"pliant": 1, "bodies": [' + b"null," * 1000000 + b"0]}"),
    ("5 MB of lists of one", lambda: b'{"pliant": 1, "bodies": [' + b"[0]," * 1250000 + b"0]}"),
    ("5 MB of objects of one", lambda: b'{"pliant": 1, "bodies": [' + b'{"":0},' * 700000 + b"0]}"),
    ("5 MB of keys", lambda: b'{"pliant": 1' + b"".join(b',"%d":0' % i for i in range(500000)) + b"}"),
    ("5 MB of vertices", lambda: SMALL.replace("[1, 0, 0.5]", ",".join(f"[{i},0,1]" for i in range(1, 400000)) + ",[0]")
     .encode()),
    ("5 MB of bodies", lambda: b'{"pliant": 1, "bodies": [' + b",".join([b'{"mesh": {"shape": "chain"}}'] * 180000) +
     b"]}"),
]


def mutations(text, count, seed):
    """The text with one, two or three bytes replaced, taken out or put in."""
    draw = random.Random(seed)
    alphabet = b'\0\xff\x80{}[]",:\\/\n\r 0129-+.eEtfnux'
    for _ in range(count):
        mutated = bytearray(text)
        for _ in range(draw.choice([1, 1, 2, 3])):
            place = draw.randrange(len(mutated))
            byte = draw.choice(alphabet)
            kind = draw.randrange(4)
            if kind == 0:
                mutated.insert(place, byte)
            elif kind == 1:
                del mutated[place]
            elif kind == 2:
                mutated[place] = byte
            else:
                end = min(len(mutated), place + draw.randrange(1, 12))
                mutated[place:place] = mutated[place:end]
        yield bytes(mutated)


class SceneSyntax(HostileTest):
    def test_the_small_scene_and_what_is_no_mistake(self):
        self.attack([run_scene_case("small", SMALL, expect=(DONE,))] +
                    [run_scene_case(name, text, expect=(DONE,)) for name, text in SOUND])

    def test_cut_at_every_length(self):
        text = SMALL.strip().encode()
        self.attack(run_scene_case(f"the first {n} bytes", text[:n], expect=(INPUT,), says=r"scene\.json:\d+:\d+: ")
                    for n in range(len(text)))

    def test_whole_files(self):
        self.attack(run_scene_case(name, text, expect=(INPUT,)) for name, text in TEXTS)

    def test_numbers(self):
        self.assertEqual(SMALL.count("2e1"), 1)
        self.attack(run_scene_case(name, SMALL.replace("2e1", text), expect=(INPUT,) if says else (DONE,), says=says)
                    for name, text, says in SPELLINGS)

    def test_a_nul_anywhere(self):
        text = SMALL.strip().encode()
        self.attack(run_scene_case(f"NUL at {n}", text[:n] + b"\0" + text[n:], expect=(INPUT,))
                    for n in range(0, len(text), 3))

    def test_mutations(self):
        self.attack(run_scene_case(f"mutation {i}", text)
                    for i, text in enumerate(mutations(SMALL.encode(), 600, seed=1)))

    def test_deep(self):
        self.attack(run_scene_case(f"{name} {n} times", opening * n, expect=(INPUT,))
                    for name, opening in DEEP for n in (63, 64, 65, 1000, BRACKETS))
        self.attack([run_scene_case("closed again", "[" * BRACKETS + "]" * BRACKETS, expect=(INPUT,))])

    def test_big(self):
        self.attack(run_scene_case(name, make(), expect=(INPUT,), memory_factor=JSON_MEMORY_FACTOR)
                    for name, make in BIG)


if __name__ == "__main__":
    hostile.main()
