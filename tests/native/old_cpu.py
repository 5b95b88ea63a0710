"""What tools/test_old_cpu.sh runs on a masked processor: every accelerator, and a small render."""

from __future__ import annotations

import sys

import numpy as np

from .meshes import ACCELS, RayScene, icosphere, random_rays, same_hits, scene_of, soup


def check_queries() -> None:
    mesh = soup(600, 0.2, seed=1)
    origins, directions = random_rays(500, seed=2)
    for test in ("watertight", "classic"):
        expected = scene_of(mesh, "none", test).intersect(origins, directions)
        assert (expected.triangle >= 0).sum() > 100
        for accel in ACCELS:
            assert same_hits(scene_of(mesh, accel, test).intersect(origins, directions), expected)


def check_shapes() -> None:
    scene = RayScene()
    scene.add_instance(scene.add_sphere())
    scene.add_instance(scene.add_plane())
    scene.build()
    hits = scene.intersect([[0, 0, 3], [5, 0, 3]], [[0, 0, -1], [0, 0, -1]])
    assert hits.t.tolist() == [2, 3]


def check_render() -> None:
    from .render_scenes import GREY, Camera, Settings, add_object, new_scene, picture

    mesh = icosphere(2)
    scene = new_scene([GREY], world=1.0)
    add_object(scene, (mesh.vertices, mesh.triangles))
    pixels = picture(scene, Settings(8, 8, 16, bounces=2, threads=1), Camera())
    assert np.isfinite(pixels).all() and 0.2 < pixels[4, 4, 0] < 0.8


def check_subnormals() -> None:
    """A triangle of subnormal size is still met: nothing flushes to zero."""
    size = np.float32(1e-39)
    scene = RayScene("none")
    corners = np.float32([[-1, -1, 0], [1, -1, 0], [0, 1, 0]]) * size
    scene.add_instance(scene.add_mesh(corners, np.int32([[0, 1, 2]])))
    scene.build()
    assert scene.intersect([[0, 0, 1]], [[0, 0, -1]]).triangle[0] == 0


def main() -> int:
    import trg_native

    in_use = trg_native.info()["instruction_set"]
    assert in_use == sys.argv[1], f"{in_use} is in use, expected {sys.argv[1]}"
    check_queries()
    check_shapes()
    check_subnormals()
    check_render()
    sys.stdout.write(f"{in_use}: queries, shapes, subnormals and a render are sound\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
