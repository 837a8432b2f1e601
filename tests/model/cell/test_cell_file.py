"""The format of cells: every key, the round trip through files, and one sentence for what is wrong."""

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast.core.files import mesh
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Mesh, Points, Sphere

EVERY_KEY = """
name: bench
margin: 0.01
objects:
  table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.5, 0, -0.02]}}
  post: {cylinder: {radius: 0.05, length: 1.0}, pose: {xyz: [0.2, 0.55, 0.5], rpy: [0, 0.1, 0]}}
  pipe: {capsule: {radius: 0.04, length: 0.6}, pose: {quaternion: [0, 0.6, 0, 0.8]}}
  ball: {sphere: 0.12, pose: {xyz: [0.45, 0.35, 0.8]}}
  ground: {half_space: [0, 1, 1], pose: {xyz: [0, 0, -0.8]}}
  jig: {mesh: jig.stl, scale: 0.001, solid: exact}
  scan: {points: scan.npy, radius: 0.005}
  sealed: {mesh: box.glb, solid: hull, margin: 0.03}
held: [{capsule: {radius: 0.02, length: 0.15}, pose: {xyz: [0, 0, 0.08]}}]
may_touch: [[table, base], [ball, panda_joint7]]
arm: {shape: meshes, spheres_to: 0.01, hold: {panda_finger_joint1: 0.04}}
"""


def ring() -> trimesh.Trimesh:
    return trimesh.creation.torus(0.2, 0.05, major_sections=24, minor_sections=12)


@pytest.fixture
def folder(tmp_path, rng):
    trimesh.Trimesh(1000 * ring().vertices, ring().faces).export(tmp_path / "jig.stl")
    trimesh.creation.box((0.2, 0.3, 0.4)).export(tmp_path / "box.glb")
    np.save(tmp_path / "scan.npy", rng.uniform(-1, 1, (100, 3)))
    (tmp_path / "cell.yaml").write_text(EVERY_KEY)
    return tmp_path


def test_every_key_is_read(folder):
    cell = hf.Cell.load(folder / "cell.yaml")
    kinds = [type(solid) for solid in cell]
    assert kinds == [Box, Cylinder, Capsule, Sphere, HalfSpace, Mesh, Points, Mesh]
    table, post, pipe, ball, ground, jig, scan, sealed = cell
    assert (table.size.tolist(), post.length, pipe.radius, ball.radius, scan.radius) == (
        [0.8, 1.2, 0.04],
        1.0,
        0.04,
        0.12,
        0.005,
    )
    np.testing.assert_allclose(post.pose[:3, :3], Rotation.from_euler("xyz", [0, 0.1, 0]).as_matrix(), atol=1e-15)
    np.testing.assert_allclose(pipe.pose[:3, :3], Rotation.from_quat([0, 0.6, 0, 0.8]).as_matrix(), atol=1e-15)
    np.testing.assert_allclose(ground.signed_distance([[0, 1, -0.8], [0, 0, -1.8]]), np.sqrt([0.5, 0.5]) * [1, -1])
    np.testing.assert_allclose(jig.surface.volume, ring().volume, rtol=1e-6)
    assert len(sealed.surface.faces) == 12
    assert (cell.name, cell.margin, cell.margin_of(sealed), cell.margin_of(jig)) == ("bench", 0.01, 0.03, 0.01)
    assert cell.held[0].radius == 0.02
    assert cell.may_touch == (("table", "base"), ("ball", "panda_joint7"))
    assert (cell.shape, cell.spheres_to, cell.hold) == ("meshes", 0.01, {"panda_finger_joint1": 0.04})
    assert str(cell) == (
        "cell 'bench': 1 box, 1 cylinder, 1 capsule, 1 sphere, 1 half space, 2 meshes, 1 point cloud; margin 0.01 m"
    )


def test_a_cell_goes_round_through_its_dictionary_and_its_file(folder, tmp_path):
    cell = hf.Cell.load(folder / "cell.yaml")
    other = tmp_path / "elsewhere"
    other.mkdir()
    assert hf.Cell.from_dict(cell.to_dict()).digest == cell.digest
    files = cell.save(other / "again.yaml")
    assert [file.name for file in files] == ["again.yaml"]
    again = hf.Cell.load(files[0])
    assert again.digest == cell.digest
    assert again.to_dict() == cell.to_dict()


def test_arrays_are_written_beside_the_file(tmp_path, rng):
    shape = ring()
    cell = hf.Cell([Mesh("ring", (shape.vertices, shape.faces)), Points("cloud", rng.normal(size=(50, 3)), radius=0.01)])
    files = cell.save(tmp_path / "cell.yaml")
    assert [file.name for file in files] == ["cell.yaml", "cell-1.obj", "cell-2.npy"]
    assert hf.Cell.load(files[0]).digest == cell.digest
    assert hf.Cell.from_dict(cell.to_dict()).digest == cell.digest


@pytest.mark.parametrize("kind", mesh.MESH_FORMATS)
def test_the_same_mesh_in_every_format(tmp_path, kind):
    shape = ring()
    shape.vertices = shape.vertices.astype(np.float32).astype(float)
    shape.export(tmp_path / f"ring.{kind}")
    found = Mesh("ring", tmp_path / f"ring.{kind}").surface
    expected = Mesh("ring", (shape.vertices, shape.faces)).surface
    assert len(found.vertices) == len(expected.vertices)
    assert cKDTree(found.vertices).query(expected.vertices)[0].max() < 1e-6
    np.testing.assert_allclose(found.volume, shape.volume, rtol=1e-5)


def test_a_surface_that_is_inside_out_is_turned():
    shape = ring()
    assert Mesh("ring", (shape.vertices, shape.faces[:, ::-1])).surface.volume > 0


def test_the_digest_knows_what_counts_and_only_that(folder):
    def digest(text: str) -> str:
        (folder / "other.yaml").write_text(text)
        return hf.Cell.load(folder / "other.yaml").digest

    base = digest(EVERY_KEY)
    assert digest(EVERY_KEY.replace("name: bench", "name: other")) == base
    changes = [("0.8, 1.2", "0.8, 1.3"), ("margin: 0.03", "margin: 0.04"), ("exact", "hull"), ("0.005", "0.006")]
    changes += [("0.15", "0.16"), ("[ball, panda_joint7]", "[ball, base]"), ("scale: 0.001", "scale: 0.002")]
    changes += [("0.04}}", "0}}"), ("ball", "sphere_1")]
    found = [digest(EVERY_KEY.replace(a, b)) for a, b in changes]
    assert len({base, *found}) == len(found) + 1


def test_files_that_changed_since_are_told(folder):
    cell = hf.Cell.load(folder / "cell.yaml")
    cell.require_unchanged()
    before = cell.digest
    with (folder / "jig.stl").open("ab") as file:
        file.write(b"\0")
    with pytest.raises(hf.InputError, match=r"'jig\.stl', the file of object 'jig', changed"):
        cell.require_unchanged()
    assert cell.digest == before
    (folder / "scan.npy").unlink()
    with pytest.raises(hf.InputError, match="changed"):
        hf.Cell([cell.objects[6]]).require_unchanged()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("box: [0.8, 1.2, 0.04]", "torus: 1", r"objects\.table\.torus: the key 'torus' is not known; the keys here are box"),
        ("box: [0.8, 1.2, 0.04], ", "", "objects.table: it has no kind"),
        ("sphere: 0.12", "sphere: 0.12, box: [1, 1, 1]", "it has box and sphere; give one"),
        ("sphere: 0.12", "sphere: -1", "objects.ball.sphere: -1 is wrong"),
        ("sphere: 0.12", "sphere: .nan", "objects.ball.sphere"),
        ("sphere: 0.12", "sphere: 0.12, scale: 2", "scale is for mesh alone"),
        ("[0, 0.6, 0, 0.8]", "[0, 0, 0, 0]", r"objects\.pipe\.pose: the quaternion \(x, y, z, w\) has length 0; it must be 1"),
        ("[0, 0.6, 0, 0.8]", "[0, 0.6, 0, 1.8]", "it must be 1"),
        ("[0, 0.6, 0, 0.8]", "[0, 1.0e+200, 0, 0.8]", r"has length 1e\+200; it must be 1"),
        ("half_space: [0, 1, 1]", "half_space: [0, 0, 0]", "the direction is 0"),
        ("rpy: [0, 0.1, 0]", "rpy: [0, 0.1, 0], quaternion: [0, 0, 0, 1]", "both rpy and quaternion"),
        ("jig.stl", "none.stl", r"object 'jig': 'none\.stl' cannot be read"),
        ("jig.stl", "jig.xyz", "not a mesh file of a known format; use STL, OBJ, GLB, PLY"),
        ("scale: 0.001", "scale: 1", r"object 'jig' is 500 m large, more than 50 m; is scale 0\.001 meant\?"),
        ("exact", "fuzzy", "objects.jig.solid: 'fuzzy' is not known"),
        (", radius: 0.005", "", "objects.scan.radius: it is missing"),
        ("scan.npy", "box.glb", r"'box\.glb' is damaged or not a \.npy file"),
        ("  ball:", "  table:", "the key 'table' is given twice"),
        ("capsule: {radius: 0.02, length: 0.15}", "half_space: [0, 0, 1]", "a half_space cannot be held"),
        ("[table, base]", "[table]", r"may_touch\[0\]: it has 1 entries; it must have 2"),
        ("margin: 0.01", "margin: -0.01", "margin"),
        ("spheres_to: 0.01", "spheres: 0.01", r"arm\.spheres: the key 'spheres' is not known"),
    ],
)
def test_what_is_wrong_is_one_sentence_that_says_where(folder, old, new, said):
    (folder / "wrong.yaml").write_text(EVERY_KEY.replace(old, new))
    with pytest.raises(hf.InputError, match=said) as caught:
        hf.Cell.load(folder / "wrong.yaml")
    assert str(caught.value).startswith("cell file '")


def test_damaged_meshes(tmp_path):
    shape = ring()
    for kind in set(mesh.MESH_FORMATS) - {"dae"}:  # its package is not one of ours
        shape.export(tmp_path / f"ring.{kind}")
    shape.export(tmp_path / "text.stl", file_type="stl_ascii")
    whole = sorted(tmp_path.iterdir())
    assert len(whole) == 5
    for file in whole:
        content = file.read_bytes()
        for share in (0.0, 0.001, 0.3, 0.7, 0.99):
            file.write_bytes(content[: int(share * len(content))])
            with pytest.raises(hf.InputError, match=r"object 'jig'"):
                Mesh("jig", file)
    (tmp_path / "some.stl").mkdir()
    with pytest.raises(hf.InputError, match="a folder"):
        Mesh("jig", tmp_path / "some.stl")


def test_surfaces_without_an_inside():
    shape = ring()
    with pytest.raises(hf.InputError, match=r"not closed, so it has no inside; close it, or use solid: hull"):
        Mesh("jig", (shape.vertices, shape.faces[1:]))
    assert Mesh("jig", (shape.vertices, shape.faces[1:]), solid="hull").surface.is_closed
    broken = shape.vertices.copy()
    broken[3, 1] = np.nan
    with pytest.raises(hf.InputError, match="NaN"):
        Mesh("jig", (broken, shape.faces))
    with pytest.raises(hf.InputError, match="flat"):
        Mesh("jig", ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), solid="hull")
    with pytest.raises(hf.InputError, match="does not exist"):
        Mesh("jig", (shape.vertices[:5], shape.faces))
    for strange in (-1, 0.5, 1e308, np.nan):
        with pytest.raises(hf.InputError, match="does not exist"):
            Mesh("jig", (shape.vertices, np.vstack([shape.faces, [0, 1, strange]])))


def test_clouds_that_are_none():
    for points in (np.zeros((0, 3)), np.zeros((5, 2)), np.zeros(3)):
        with pytest.raises(hf.InputError, match="at least one point"):
            Points("scan", points, radius=0.01)
    with pytest.raises(hf.InputError, match="NaN"):
        Points("scan", np.full((2, 3), np.nan), radius=0.01)
    with pytest.raises(hf.InputError, match="millimetres"):
        Points("scan", [[0, 0, 0], [900, 0, 0]], radius=0.01)
    with pytest.raises(hf.InputError, match="from the origin of its own frame"):
        Points("scan", [[1e300, 0, 0]], radius=0.01)
    with pytest.raises(hf.InputError, match="radius"):
        Points("scan", np.zeros((2, 3)), radius=0.0)


def test_without_the_extra_a_mesh_file_says_so(folder, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    with pytest.raises(hf.HoldfastError, match=r"holdfast-arms\[cell\]"):
        hf.Cell.load(folder / "cell.yaml")


def test_stl_files_are_read_without_a_package(tmp_path, monkeypatch):
    shape = ring()
    shape.export(tmp_path / "ring.stl")
    shape.export(tmp_path / "text.stl", file_type="stl_ascii")
    theirs = trimesh.load_mesh(tmp_path / "ring.stl")
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    for name in ("ring.stl", "text.stl"):
        surface, _ = mesh.read_mesh(tmp_path / name)
        assert surface.is_closed
        assert len(surface.vertices) == len(theirs.vertices)
        assert surface.volume == pytest.approx(theirs.volume, rel=1e-6)
    text = (tmp_path / "text.stl").read_text()
    for wrong in (text.replace("vertex", "vertex x", 1), text.replace("vertex", "corner", 1)):
        (tmp_path / "text.stl").write_text(wrong)
        with pytest.raises(hf.InputError, match="damaged"):
            mesh.read_mesh(tmp_path / "text.stl")


def test_a_capsule_file_is_beside_the_cell_and_counts_by_its_content(tmp_path, monkeypatch):
    arm = hf.arms.load("planar-2r")
    for place, radius in (("here", 0.05), ("there", 0.05), ("wide", 0.06)):
        (tmp_path / place).mkdir()
        (tmp_path / place / "tip.yaml").write_text(f"radius: {radius}\n")
        (tmp_path / place / "cell.yaml").write_text("objects: {ball: {sphere: 0.1}}\narm: {shape: tip.yaml}\n")
    monkeypatch.chdir(tmp_path / "wide")
    here, there, wide = (hf.Cell.load(tmp_path / place / "cell.yaml") for place in ("here", "there", "wide"))
    assert hf.Clearance(arm, cell=hf.Cell([], shape=here.shape)).capsules.parts[0].radius == 0.05
    assert here.digest == there.digest != wide.digest
    file = here.save(tmp_path / "saved.yaml")[0]
    assert "shape: here/tip.yaml" in file.read_text()
    for back in (hf.Cell.load(file), hf.Cell.from_dict(here.to_dict())):
        assert back.digest == here.digest
    (tmp_path / "here" / "tip.yaml").unlink()
    with pytest.raises(hf.InputError, match=r"capsule file '.*here.tip\.yaml' cannot be read"):
        hf.Cell.load(tmp_path / "here" / "cell.yaml").digest  # noqa: B018
