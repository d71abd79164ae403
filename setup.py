"""The Python package: pip install .

The compiled part is made by CMake, as everything else, in build/python; some ten minutes on two cores. PELAGE_BUILD in the
environment names a build folder that has it already (PELAGE_PYTHON=ON).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        built = os.environ.get("PELAGE_BUILD")
        folder = pathlib.Path(built) if built else self.compile()
        shutil.copy2(folder / "python" / "pelage" / target.name, target)

    def compile(self):
        build = ROOT / "build" / "python"
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DPELAGE_TESTS=OFF",
                        "-DPELAGE_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "pelage_python", "--parallel", str(os.cpu_count())],
                       check=True)
        return build


version = re.search(r"project\(pelage VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
setup(
    name="pelage",
    version=version,
    description="Grows reaction-diffusion coats directly on surfaces",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["pelage"],
    package_dir={"": "python"},
    package_data={"pelage": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("pelage._core", [])],
    cmdclass={"build_ext": CMakeBuild},
)
