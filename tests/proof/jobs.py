"""Job folders for engine programs, bundles for the inspector, and the pictures that both write."""
import json
import os

import numpy as np

import scenes


def columns(matrix):
    return [float(x) for x in np.asarray(matrix).T.reshape(-1)]


def write_job(folder, engine, scene, kernel, parameters):
    """Writes a job folder for an engine program."""
    os.makedirs(folder, exist_ok=True)
    for stale in ("mask.pgm", "facts.json"):
        if os.path.exists(os.path.join(folder, stale)):
            os.remove(os.path.join(folder, stale))
    rows, first_vertex, first_index, indices = [], 0, 0, []
    for o in scene.objects:
        rows.append({"name": o.name, "first_index": first_index, "index_count": int(o.indices.size), "casts": True,
                     "receives": True, "double_sided": o.double_sided})
        indices.append(o.indices + np.uint32(first_vertex))
        first_vertex += len(o.positions)
        first_index += int(o.indices.size)
    for name, arrays in (("positions.f32", [o.positions for o in scene.objects]),
                         ("normals.f32", [o.normals for o in scene.objects]), ("indices.u32", indices)):
        np.concatenate(arrays).tofile(os.path.join(folder, name))
    job = {"engine": engine, "scene": scene.name, "objects": rows, "positions": "positions.f32",
           "normals": "normals.f32", "indices": "indices.u32",
           "camera": {"width": scene.width, "height": scene.height, "view_from_world": columns(scene.view_from_world),
                      "clip_from_view": columns(scene.clip_from_view), "fov_y_deg": scene.fov_y_deg,
                      "near_m": scene.near_m, "far_m": scene.far_m},
           "light": {"to_light_ws": scene.to_light.tolist(), "view_from_world": columns(scene.light_view_from_world),
                     **scene.box},
           "map_resolution": scene.resolution, "kernel": kernel, "parameters": parameters}
    with open(os.path.join(folder, "job.json"), "w") as file:
        json.dump(job, file, indent=1)


def write_bundle(folder, scene, clip_from_world, texels, reversed_z=False, depth_range="-1..1"):
    """Writes a bundle whose light has the engine's matrix. Its map is empty, since the inspector draws its own."""
    os.makedirs(folder, exist_ok=True)
    scenes.write_glb(os.path.join(folder, "scene.glb"), scene.objects)
    np.full(texels * texels, 0 if reversed_z else 1, np.float16).tofile(os.path.join(folder, "map.raw"))
    frame = {"bundle": 1, "made_by": "proof in engines", "scene": "scene.glb",
             "camera": {"clip_from_world": columns(scene.camera_clip_from_world()), "width": scene.width,
                        "height": scene.height, "depth": {"range": "-1..1", "reversed": False}},
             "lights": [{"name": "sun", "type": "directional", "direction": (-scene.to_light).tolist(), "choice": "one",
                         "maps": [{"image": {"file": "map.raw", "width": texels, "height": texels, "format": "f16"},
                                   "clip_from_world": columns(clip_from_world),
                                   "depth": {"range": depth_range, "reversed": reversed_z}}]}]}
    with open(os.path.join(folder, "frame.json"), "w") as file:
        json.dump(frame, file, indent=1)


def read_pfm(path):
    """Returns a PFM picture, top row first."""
    with open(path, "rb") as file:
        kind = file.readline().strip()
        width, height = map(int, file.readline().split())
        order = "<" if float(file.readline()) < 0 else ">"
        values = np.frombuffer(file.read(), order + "f4").reshape(height, width, 3 if kind == b"PF" else 1)
    return values[::-1, :, 0].astype(np.float32)


def read_pgm(path):
    """Returns an 8-bit PGM picture as floats from 0 to 1, top row first."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"P5":
            raise ValueError(f"{path}: not a binary PGM file")
        words = []
        while len(words) < 3:
            words += file.readline().split(b"#")[0].split()
        width, height, largest = map(int, words)
        values = np.frombuffer(file.read(width * height), np.uint8)
    return values.reshape(height, width).astype(np.float32) / largest
