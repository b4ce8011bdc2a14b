"""Command lines that are wrong: every option of every sub-command with every kind of value, as the program's help lists them."""
import hostile
from hostile import (DONE, INPUT, INTERRUPTED, LEGAL, OUTPUT, Case, HostileTest, options_of, scene_of, sub_commands)

VALUES = ["", " ", "0", "-0", "-1", "+1", "1", "0.5", "1e0", "1e3", "1e-320", "1e308", "1e999", "-1e999", "nan", "-nan", "inf", "-inf",
          "0x10", "010", "0b1", "1_000", "1'000", "1,5", "1.5.5", "1 1", "1x", "x", "٣", "½", "2147483647", "2147483648",
          "4294967297", "9223372036854775808", "-9223372036854775809", "9" * 1000, "true", "--", "-", "--quiet",
          "--out", "NPY", "npy ", "npy,obj", "eigen\n", "\x1b[31m", "a" * 100000, "%s%n", "../..", "/", "[1]", "{}",
          "1;2", "$(id)", "*"]
SCENE = {"scene.json": scene_of({"shape": "chain", "links": 2}, {"type": "edge_spring"})}

# Which has work enough without any words, in workloads that take what they take.
LONG = {"interrupt_after": 2, "input_size": 1 << 30}

LINES = [
    [], [""], [" "], ["-"], ["--"], ["-x"], ["--hlep"], ["--version=1"], ["run"], ["run", ""], ["run", "--"], ["run", "--out"],
    ["run", "scene.json", "scene.json"], ["run", "scene.json", "--out", "a", "--out", "b"], ["run", "scene.json", "--steps"],
    ["run", "scene.json", "--steps", "1", "--steps", "2"], ["run", "scene.json", "--out", "out", "--steps=", "1"],
    ["run", "scene.json", "--step", "1"], ["run", "scene.json", "-steps", "1"], ["run", "scene.json", "--STEPS", "1"],
    ["run", "scene.json", "--quiet=maybe"], ["run", "scene.json", "--out", "out", "--quiet", "--quiet"], ["Run", "scene.json"], ["rnu"],
    ["run scene.json"], ["scenes", "x"], ["scenes", "run"], ["run", "scenes"], ["scenes", "--out", "x"], ["help"], ["run", "-"],
    ["run", "nothing.json"], ["run", "curtian"], ["run", "CHAIN"], ["run", "chain.json"], ["run", "a" * 100000], ["a" * 100000],
    ["run", "/"], ["run", "."], ["run", ".."], ["run", "scene.json/"], ["run", "scene.json/x"], ["run", "\x1b[31mred\x1b[0m"],
    ["run", "two\nlines"], ["run", "carriage\rreturn"], ["run", "bell\x07"], ["run", "\u202eright to left"], ["\x1b[2J"],
    ["run", b"\xff\xfe"], [b"\xff"], ["run", "scene.json", b"--\xff"], ["run", "scene.json", "--format", b"\xff"],
    ["run", "http://example.org/scene.json"], ["run", "~/scene.json"], ["run", "*.json"], ["run", "scene.json;ls"],
    ["run", "@scene.json"], ["--config", "scene.json"], ["run", "%s%s%s%n"], ["run", "{}"], ["run", "{0:>99999999}"],
    ["run", "scene.json", "--out", "out", *["--quiet"] * 1000], ["run", *["scene.json"] * 1000], ["run", "scene.json", "--set"],
]


class CommandLine(HostileTest):
    def test_lines(self):
        self.attack(Case(f"line {line!r:.60}", line, SCENE, expect=(DONE, INPUT, OUTPUT)) for line in LINES)

    def test_unknown_options_and_words_name_what_is_wrong(self):
        self.attack([Case("sub-command", ["rnu"], expect=(INPUT,), says="rnu"),
                     Case("option", ["run", "scene.json", "--stesp", "3"], SCENE, expect=(INPUT,), says="--stesp"),
                     Case("value", ["run", "scene.json", "--steps", "3x"], SCENE, expect=(INPUT,), says="3x", place="--steps"),
                     Case("scene", ["run", "curtian"], expect=(INPUT,), says="did you mean 'curtain'")])

    def test_every_option_with_every_value(self):
        """What takes long, or for ever, is interrupted."""
        def cases():
            for name, kind in options_of("run"):
                for i, value in enumerate(VALUES if kind else VALUES[:3]):
                    words = [f"{name}={value}"] if i % 2 else [name, value]
                    yield Case(f"{words!r:.50}", ["run", "scene.json", "--out", "out", *words], SCENE, interrupt_after=0.5,
                               expect=(*LEGAL, OUTPUT, INTERRUPTED))
        self.attack(cases())

    def test_every_sub_command_without_and_with_too_much(self):
        self.assertIn("run", sub_commands())
        self.attack((Case(f"{command} {words}", [command, *words], SCENE, expect=(DONE, *LEGAL, OUTPUT, INTERRUPTED),
                          **(LONG if command == "bench" else {}))
                     for command in sub_commands() for words in ([], [""], ["-"], ["--"], ["nothing"], ["/dev/null"], ["."],
                                                                 ["scene.json"] * 9, ["a" * 5000], [b"\xff"], ["\x1b[31m"],
                                                                 ["--nothing"], ["--help", "x"])),
                    (Case(f"{command} {name} {value!r:.40}", [command, "scene.json", name, value], SCENE,
                          expect=(*LEGAL, OUTPUT, INTERRUPTED), **(LONG if command == "bench" else {}))
                     for command in sub_commands() if command != "run" for name, kind in options_of(command)
                     for value in VALUES if kind))

    def test_help_and_version_are_quiet_and_done(self):
        self.attack(Case(f"{line}", line, expect=(DONE,)) for line in
                    [["--help"], ["-h"], ["--version"], *([command, "--help"] for command in sub_commands())])


if __name__ == "__main__":
    hostile.main()
