"""Runs the notebooks of python/notebooks/ and keeps what they print and draw in them:

    PYTHONPATH="$PWD/build/release/python" PATH="$PWD/build/release/bin:$PATH" /usr/bin/python3 scripts/make_notebooks.py

Needs Debian's python3-nbclient, python3-ipykernel and python3-matplotlib. The tests run the same cells without Jupyter.
"""
import pathlib
import sys

import nbformat
from nbclient import NotebookClient

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "python" / "notebooks"


def without_traces(notebook):
    """Leaves out what differs from run to run: times, and names of the machine."""
    for cell in notebook.cells:
        cell.metadata = {}
        if cell.cell_type == "code":
            for output in cell.outputs:
                output.get("metadata", {}).clear()
    notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
                         "language_info": {"name": "python"}}


def main():
    for path in sorted(FOLDER.glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        NotebookClient(notebook, timeout=300, kernel_name="python3").execute(cwd=str(FOLDER))
        without_traces(notebook)
        nbformat.write(notebook, path)
        print(path.name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
