"""Mesh files of every format that are cut off, mangled, or hold what are no numbers."""
import random
import re

import hostile
from hostile import DONE, INPUT, HostileTest
from meshes import known_formats, mesh_cases

TOKENS = ["nan", "-nan", "NaN(1)", "inf", "-inf", "infinity", "1e999", "-1e999", "1e-400", "1e-310", "-0", "0", "-1", "+1", "++1",
          "+-1", "1.", ".5", ".", "-", "+", "e", "1e", "1e+", "0x10", "0b1", "010", "1,5", "1.5.5", "1_0", "1/2", "٣", "–1",
          "x", "\"1\"", "1;", "2147483647", "2147483648", "-2147483648", "4294967296", "4294967297", "9223372036854775807",
          "9223372036854775808", "-9223372036854775808", "18446744073709551616", "9" * 400, "1" + "0" * 400,
          "0." + "0" * 400 + "1", "1e2147483648", "1e-2147483649", "1e99999999999999999999", "\0", "\x1b[31m", "\x7f", "\\", "#", "1 1",
          "", "\ufeff", "\u00a0", "a" * 100000]

BYTES = bytes([0, 0x7f, 0x80, 0xff, ord("-"), ord("9"), ord("\n"), ord(" ")])

# Whole files of no format.
TEXTS = [b"", b" ", b"\n" * 1000, b"\0", b"\0" * 1000, b"\xff" * 1000, b"\xef\xbb\xbf", b"x" * 10000, bytes(range(256)) * 10,
         b"# only a comment", b"\\\n" * 1000, b"\\", b"{}", b"<html>404 Not Found</html>", b"\x89PNG\r\n\x1a\n" + b"\0" * 100,
         b"PK\x03\x04" + bytes(100), b"\x1f\x8b" + bytes(100), b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
         b"\x7fELF" + bytes(100), b"%PDF-1.4\n", b"glTF" + bytes(20), b"Kaydara FBX Binary  \0"]


def tokens_of(text):
    """(begin, end) of every word of a text; of a binary PLY those of its head."""
    head = text.split(b"end_header")[0]
    return [match.span() for match in re.finditer(rb"[^\s/]+", head)]


def mutations(text, count, seed):
    draw = random.Random(seed)
    for _ in range(count):
        mutated = bytearray(text)
        for _ in range(draw.choice([1, 2, 4])):
            place = draw.randrange(len(mutated))
            kind = draw.randrange(4)
            if kind == 0:
                mutated[place] = draw.randrange(256)
            elif kind == 1:
                mutated[place] ^= 1 << draw.randrange(8)
            elif kind == 2:
                del mutated[place:place + draw.randrange(1, 9)]
            else:
                mutated[place:place] = mutated[place:place + draw.randrange(1, 30)]
            if not mutated:
                break
        yield bytes(mutated)


class MeshSyntax(HostileTest):
    def attack_formats(self, variants, **more):
        """`variants` makes (name, contents) of a format."""
        self.attack(case for name, form in known_formats().items() for what, contents in variants(form)
                    for case in mesh_cases(f"{name}: {what}", form.suffix, contents, **more))

    def test_the_small_files_and_what_is_no_mistake(self):
        def sound(form):
            yield "small", form.small
            if form.is_text:
                yield "BOM", b"\xef\xbb\xbf" + form.small
                yield "CRLF", form.small.replace(b"\n", b"\r\n")
                yield "CR", form.small.replace(b"\n", b"\r")
                yield "no line end", form.small.rstrip()
                yield "blanks", form.small.replace(b" ", b" \t ").replace(b"\n", b" \t\n")
                yield "empty lines behind", form.small + b"\n \n\t\n\n"
        self.attack_formats(sound, expect=(DONE,))

    def test_cut_at_every_length(self):
        self.attack_formats(lambda form: ((f"the first {n} bytes", form.small[:n]) for n in range(len(form.small))))

    def test_a_nul_anywhere(self):
        self.attack_formats(lambda form: [(f"NUL at {n}", form.small[:n] + b"\0" + form.small[n:])
                                          for n in range(0, len(form.small), 5) if form.is_text], expect=(INPUT,))

    def test_other_encodings(self):
        def encoded(form):
            if form.is_text:
                for encoding in ("utf-16", "utf-16-be", "utf-32"):
                    yield encoding, form.small.decode().encode(encoding)
        self.attack_formats(encoded, expect=(INPUT,))

    def test_other_words(self):
        def replaced(form):
            draw = random.Random(1)
            for begin, end in tokens_of(form.small) if form.is_text or form.suffix == "ply" else ():
                word = form.small[begin:end].decode("latin-1")
                for token in TOKENS if re.fullmatch(r"-?[\d.]+", word) and draw.random() < 0.3 else draw.sample(TOKENS, 3):
                    yield f"{token!r:.40} for {word} at {begin}", form.small[:begin] + token.encode() + form.small[end:]
        self.attack_formats(replaced)

    def test_other_bytes(self):
        def replaced(form):
            for place in range(len(form.small)):
                for byte in random.Random(place).sample(list(BYTES), 1 if form.is_text else 2):
                    yield f"byte {place} is {byte}", form.small[:place] + bytes([byte]) + form.small[place + 1:]
        self.attack_formats(replaced)

    def test_mutations(self):
        self.attack_formats(lambda form: ((f"mutation {i}", text) for i, text in
                                          enumerate(mutations(form.small, 60, seed=7))))

    def test_rows_in_another_order_twice_or_left_out(self):
        def rearranged(form):
            rows = form.small.splitlines(keepends=True) if form.is_text else []
            for i in range(len(rows)):
                yield f"without row {i}", b"".join(rows[:i] + rows[i + 1:])
                yield f"row {i} twice", b"".join(rows[:i + 1] + rows[i:])
                yield f"row {i} last", b"".join(rows[:i] + rows[i + 1:] + rows[i:i + 1])
                yield f"row {i} first", b"".join(rows[i:i + 1] + rows[:i] + rows[i + 1:])
        self.attack_formats(rearranged)

    def test_what_is_no_mesh_at_all(self):
        self.attack_formats(lambda form: ((f"{text[:20]}", text) for text in TEXTS), expect=(INPUT,))

    def test_other_suffixes(self):
        suffixes = {form.suffix for form in known_formats().values()} | {"txt", "OBJ", "obj.gz", ""}
        self.attack(case for name, form in known_formats().items() for suffix in sorted(suffixes - {form.suffix})
                    for case in mesh_cases(f"{name} called {suffix}", suffix, form.small))


if __name__ == "__main__":
    hostile.main()
