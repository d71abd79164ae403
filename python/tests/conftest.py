"""What the tests share. PELAGE in the environment: the program that the package is held against."""

import os
import subprocess

import pytest


@pytest.fixture(scope="session")
def program():
    """Runs the program with these arguments in a folder and returns what it prints. Its files tell nothing of how they
    were made, which those of the package do not, either."""
    path = os.environ.get("PELAGE")
    if not path:
        pytest.skip("PELAGE names no program")

    def run(*arguments, folder):
        silent = ["--no-record"] if "-o" in arguments else []
        done = subprocess.run([path, *map(str, arguments), *silent], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.fixture(scope="session")
def sphere():
    """A geodesic sphere of radius 1 as arrays."""
    import pelage
    shape = pelage.load("builtin:sphere?n=642")
    return shape.points, shape.triangles
