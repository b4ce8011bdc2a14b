"""Builds the compiled part by CMake: `pip wheel . --no-build-isolation --no-deps` in this folder.

A wheel has no CHOLMOD, some of whose modules are under the GPL: it factorizes with Eigen.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent


def version():
    """0.2.0.dev0 for 0.2.0-dev, which stands in CMakeLists.txt alone."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    number = re.search(r"project\(pliant VERSION ([\d.]+)", text)[1]
    suffix = re.search(r'set\(PLIANT_VERSION_SUFFIX "([^"]*)"\)', text)[1]
    return number + suffix.replace("-dev", ".dev0")


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(self.build_temp).resolve()
        parts = ["CLI", "TESTS", "EXAMPLES", "STUDIES"]
        subprocess.run(
            ["cmake", "-S", str(ROOT), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DCMAKE_UNITY_BUILD=ON", "-DPLIANT_BUILD_PYTHON=ON", "-DPLIANT_CHOLMOD=OFF", "-DPLIANT_INSTALL=OFF",
             f"-DPython3_EXECUTABLE={sys.executable}", *(f"-DPLIANT_BUILD_{part}=OFF" for part in parts)],
            check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", str(folder), "--target", "pliant_python", "--parallel", jobs], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(next((folder / "python" / "pliant").glob("_pliant*.so")), target)


setup(version=version(), packages=["pliant"], package_data={"pliant": ["*.pyi", "py.typed"]}, zip_safe=False,
      ext_modules=[Extension("pliant._pliant", sources=[])], cmdclass={"build_ext": CMakeBuild})
