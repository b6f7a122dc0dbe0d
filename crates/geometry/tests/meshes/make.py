"""Makes the meshes of this folder with trimesh, manifold3d and PyVista (VTK), and distances to them by VTK.

    pip install trimesh manifold3d pyvista numpy scipy && python make.py

Lengths are millimetres. README.md says what each file is for.
"""

import sys
from pathlib import Path

import numpy as np
import pyvista as pv
import trimesh
from trimesh import creation

HERE = Path(__file__).parent
RANDOM = np.random.default_rng(7)


def save(mesh, name):
    path = HERE / name
    text = name.endswith(".ascii.stl")
    if isinstance(mesh, pv.PolyData):
        mesh = mesh.triangulate()
        pv.save_meshio(path, mesh) if name.endswith(".obj") else mesh.save(path, binary=not text)
    else:
        mesh.export(path, file_type="stl_ascii" if text else name.rsplit(".", 1)[-1])
    volume = mesh.volume if isinstance(mesh, pv.PolyData) else float(mesh.volume)
    print(f"{name}: {path.stat().st_size} bytes, volume {volume:.6g} mm^3")


def without(mesh, faces):
    keep = np.ones(len(mesh.faces), bool)
    keep[faces] = False
    return trimesh.Trimesh(mesh.vertices, mesh.faces[keep], process=False)


def flipped(mesh, faces):
    turned = mesh.faces.copy()
    turned[faces] = turned[faces][:, ::-1]
    return trimesh.Trimesh(mesh.vertices, turned, process=False)


def distances(mesh, name):
    """Signed distances by vtkImplicitPolyDataDistance at points in and around the box of the mesh."""
    import vtk

    surface = pv.wrap(mesh) if not isinstance(mesh, pv.PolyData) else mesh.triangulate()
    surface = surface.clean()
    function = vtk.vtkImplicitPolyDataDistance()
    function.SetInput(surface)
    low, high = np.array(surface.bounds[0::2]), np.array(surface.bounds[1::2])
    points = RANDOM.uniform(low - 0.3 * (high - low), high + 0.3 * (high - low), (150, 3)).astype(np.float32)
    with open(HERE / name, "w") as file:
        file.write(f"# signed distances by VTK {vtk.vtkVersion.GetVTKVersion()}, vtkImplicitPolyDataDistance\n")
        file.write("x [mm],y [mm],z [mm],distance [mm]\n")
        for x in points:
            d = function.EvaluateFunction([float(c) for c in x])
            file.write(",".join(repr(float(c)) for c in x) + f",{d:.9g}\n")


ball = creation.icosphere(subdivisions=2, radius=10.0)
save(without(ball, RANDOM.choice(len(ball.faces), 12, replace=False)), "ball-with-holes.stl")

capsule = creation.capsule(height=20.0, radius=5.0, count=[12, 12])
save(flipped(capsule, RANDOM.choice(len(capsule.faces), len(capsule.faces) // 4, replace=False)), "capsule-flipped.stl")

plate = trimesh.boolean.difference(
    [creation.box((40, 20, 1.5))]
    + [creation.cylinder(4.0, height=5.0, sections=24).apply_translation((x, 0, 0)) for x in (-12, 0, 12)],
    engine="manifold",
)
save(plate, "plate-with-bores.stl")
distances(trimesh.load(HERE / "plate-with-bores.stl"), "plate-with-bores.csv")

save(creation.annulus(r_min=8.0, r_max=10.0, height=30.0, sections=32), "tube.obj")

inner, outer = creation.icosphere(subdivisions=1, radius=6.0), creation.icosphere(subdivisions=2, radius=10.0)
save(trimesh.util.concatenate([outer, inner]), "hollow-ball-both-outwards.obj")

one, other = creation.box((20, 10, 10)), creation.box((10, 10, 20)).apply_translation((5, 2, 5))
save(trimesh.util.concatenate([one, other]), "two-boxes-crossing.stl")

pebble = pv.ParametricSuperEllipsoid(xradius=12, yradius=6, zradius=4, n1=1.2, n2=0.7, u_res=10, v_res=10, w_res=10)
pebble = pebble.extract_surface(algorithm="dataset_surface").triangulate()
# Points of the poles and of the seam are there several times: they stay, as another program would write them.
save(pv.PolyData(pebble.points, faces=pebble.faces), "superellipsoid.ascii.stl")

torus = pv.ParametricTorus(ringradius=10, crosssectionradius=3, u_res=28, v_res=14, w_res=14)
torus = torus.extract_surface(algorithm="dataset_surface").triangulate().clean()
save(torus, "torus.stl")
distances(pv.read(HERE / "torus.stl"), "torus.csv")

save(pv.Cylinder(radius=5, height=20, resolution=24, capping=False), "pipe-without-ends.stl")
save(pv.ParametricMobius(radius=10, u_res=24, v_res=5, w_res=5).extract_surface(algorithm="dataset_surface").clean(), "moebius.stl")
save(pv.Plane(i_size=10, j_size=10, i_resolution=4, j_resolution=4), "sheet.stl")
print(trimesh.__version__, pv.__version__, sys.version.split()[0])
