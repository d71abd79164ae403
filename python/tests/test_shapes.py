"""What goes in: arrays and the objects of other libraries; and that large arrays are not copied on the way out."""

import types

import numpy as np
import pytest

import pelage

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
QUADS = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]]


def address(array):
    return array.__array_interface__["data"][0]


def test_quads_become_triangles():
    shape = pelage.Shape(CUBE, QUADS)
    assert shape.kind == "surface" and shape.triangles.shape == (12, 3)
    corners = shape.points[shape.triangles]
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(1)


def test_mixed_faces():
    mixed = [QUADS[0][:3], [QUADS[0][0], *QUADS[0][2:]]] + QUADS[1:]
    assert len(pelage.Shape(CUBE, mixed).triangles) == 12


def test_attributes_go_where_their_number_fits():
    shape = pelage.Shape(CUBE, QUADS, attributes={"heat": np.arange(8), "wind": np.ones((8, 3)), "part": np.arange(6)},
                         uv=np.tile([[0, 0], [1, 0], [1, 1], [0, 1]], (6, 1)))
    assert shape.attributes["heat"].shape == (8,) and shape.attributes["wind"].shape == (8, 3)
    assert shape.attributes["uv"].shape == (36, 2) and shape.attributes["part"].shape == (12,)
    assert np.array_equal(shape.attributes["heat"], np.arange(8))
    with pytest.raises(pelage.UsageError, match="cold has 7 rows"):
        pelage.Shape(CUBE, QUADS, attributes={"cold": np.zeros(7)})


def test_formulas_read_attributes(sphere):
    points, triangles = sphere
    coat = pelage.grow(pelage.Shape(points, triangles, attributes={"heat": points[:, 2]}), size=0.3, keep_shape=True,
                       species="b", parameters={"size": "1 + 0.5*attribute(heat)"}, steps=5)
    assert np.array_equal(coat.attributes["heat"], points[:, 2])


@pytest.mark.parametrize("faces, message", [([[0, 1, 8]], "vertex 8"), ([[0, 1, -1]], "from 0"),
                                            (np.array([[0.5, 1, 2]]), "float64")])
def test_faces_that_are_none(faces, message):
    with pytest.raises((pelage.InputError, pelage.UsageError), match=message):
        pelage.Shape(CUBE, faces)


def test_points_that_are_none():
    with pytest.raises(ValueError, match="shape \\(n, 3\\)"):
        pelage.Shape(CUBE[:, :2], QUADS)
    with pytest.raises(pelage.InputError):
        pelage.Shape(np.full((8, 3), np.nan), QUADS)


def test_objects_of_other_libraries():
    trimesh = types.SimpleNamespace(vertices=CUBE, faces=np.array(QUADS))
    meshio = types.SimpleNamespace(points=CUBE, cells_dict={"quad": np.array(QUADS), "line": np.zeros((3, 2), int)})
    pyvista = types.SimpleNamespace(points=CUBE, faces=np.array([n for face in QUADS for n in (4, *face)]))
    for shape in (trimesh, meshio, pyvista, (CUBE, QUADS)):
        assert np.array_equal(pelage.as_shape(shape).triangles, pelage.Shape(CUBE, QUADS).triangles)
    with pytest.raises(pelage.UsageError, match="a dict is no shape"):
        pelage.as_shape({})
    with pytest.raises(pelage.UsageError, match="the cells are line"):
        pelage.as_shape(types.SimpleNamespace(points=CUBE, cells_dict={"line": np.zeros((3, 2), int)}))


def test_meshio():
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(CUBE, [("quad", np.array(QUADS))])
    assert np.array_equal(pelage.as_shape(mesh).triangles, pelage.Shape(CUBE, QUADS).triangles)


def test_findings(sphere):
    points, triangles = sphere
    shape = pelage.Shape(points, np.vstack([triangles, triangles[:1]]))
    assert [(f["kind"], f["count"], f["repaired"]) for f in shape.findings] == [("duplicate-faces", 1, True)]


def test_views_are_not_copies(sphere):
    coat = pelage.grow(sphere, size=0.3, steps=5)
    for name in ("points", "triangles", "colors", "normals"):
        first = getattr(coat, name)
        assert address(first) == address(getattr(coat, name)), name
        assert not first.flags.owndata and not first.flags.writeable
    assert address(coat.attributes["color"]) == address(coat.colors)
    assert address(coat.fields["b"]) == address(coat.fields["b"])
    with pytest.raises(ValueError):
        coat.points[0, 0] = 1


def test_views_outlive_their_coat(sphere):
    points = pelage.grow(sphere, size=0.3, steps=1).points
    copy = points.copy()
    pelage.grow(sphere, size=0.3, steps=1)
    assert np.array_equal(points, copy)


def test_a_cloud_of_points(sphere):
    cloud = pelage.Shape(sphere[0])
    assert cloud.kind == "points"
    coat = pelage.grow(cloud, size=0.3, steps=20)
    assert len(coat.points) >= len(sphere[0]) / 2


def test_uv_is_made(sphere):
    shape = pelage.Shape(*sphere).with_uv(256)
    uv = shape.attributes["uv"]
    assert uv.shape == (3 * len(sphere[1]), 2) and uv.min() >= 0 and uv.max() <= 1
