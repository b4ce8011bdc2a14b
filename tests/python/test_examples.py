"""The examples run to their ends, and what docs/python.md and the README quote is part of them or runs by itself."""
import contextlib
import io
import os
import pathlib
import re
import runpy
import tempfile
import textwrap
import unittest

SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])
EXAMPLES = SOURCE / "python" / "examples"


def quoted(source, name):
    """What stands between the two lines `# [name]`."""
    marker = re.escape(f"# [{name}]")
    return textwrap.dedent(re.search(rf"{marker}\n(.*\n) *{marker}\n", source, re.DOTALL)[1])


class Examples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def test_they_run(self):
        for example in sorted(EXAMPLES.glob("*.py")):
            with self.subTest(example.name), contextlib.redirect_stdout(io.StringIO()):
                runpy.run_path(str(example))

    def test_quotes_are_parts_of_them(self):
        page = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
        quotes = re.findall(r"<!-- (python/examples/\S+\.py): ([\w ]+) -->\n```python\n(.*?)```", page, re.DOTALL)
        self.assertGreaterEqual(len(quotes), 5)
        for file, name, quote in quotes:
            self.assertEqual(quote, quoted((SOURCE / file).read_text(encoding="utf-8"), name), file)

    def test_the_other_snippets_run_in_their_order(self):
        for page in ("docs/python.md", "README.md"):
            text = (SOURCE / page).read_text(encoding="utf-8")
            snippets = re.findall(r"(?<!-->\n)```python\n(.*?)```", text, re.DOTALL)
            self.assertGreaterEqual(len(snippets), 1, page)
            names = {}
            for snippet in snippets:
                exec(compile(snippet, page, "exec"), names)


if __name__ == "__main__":
    unittest.main()
