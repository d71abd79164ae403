"""The package is typed throughout, and what it offers is exported."""

import pathlib

import pytest

import pelage


def test_types():
    api = pytest.importorskip("mypy.api")
    sources = pathlib.Path(pelage.__file__).parent
    said, faults, status = api.run(["--strict", "--enable-incomplete-feature=Unpack", "--cache-dir=/dev/null",
                                    *map(str, sorted(sources.glob("*.py")))])
    assert status == 0, said + faults


def test_names():
    assert sorted(pelage.__all__) == pelage.__all__
    for name in pelage.__all__:
        assert getattr(pelage, name).__doc__, name


def test_stub_has_all_of_the_module():
    """_core.pyi names what is there, and nothing else."""
    stub = pathlib.Path(pelage.__file__).with_name("_core.pyi").read_text()
    for name in dir(pelage._core):
        if not name.startswith("_"):
            assert f"class {name}:" in stub or f"def {name}(" in stub or f"\n{name}:" in stub, name
