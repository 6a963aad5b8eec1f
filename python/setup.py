# SPDX-License-Identifier: Apache-2.0
"""Builds the module by CMake; the version is that of the project."""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
    """Configures, builds and installs the component python below the folder that becomes the wheel."""

    def build_extension(self, ext):
        given = os.environ.get("PIOLA_BUILD_FOLDER")  # pip builds in another working folder: not from there
        build = (ROOT / given if given else Path(self.build_temp)).resolve()
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        build.mkdir(parents=True, exist_ok=True)
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DPIOLA_PYTHON=ON", "-DPIOLA_TESTS=OFF", "-DPIOLA_TOGETHER=ON",
                   "-DPIOLA_FINITE_ELEMENTS=OFF", f"-DPython_EXECUTABLE={sys.executable}", "-DPIOLA_PYTHON_INSTALL=."]
        options += os.environ.get("PIOLA_CMAKE_OPTIONS", "").split()
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", *options], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "piola_python", "piola_python_files"], check=True)
        subprocess.run(["cmake", "--install", str(build), "--component", "python", "--prefix", str(target)], check=True)


setup(
    version=re.search(r"project\(Piola VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
    packages=[],  # the files come from the install rules
    ext_modules=[Extension("piola._piola", [])],
    cmdclass={"build_ext": CMakeBuild},
)
