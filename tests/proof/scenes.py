"""Scenes of the proof: objects in world space, a camera and the box of one directional light."""
import json
import math
import struct

import numpy as np


def look_at(eye, target, up=(0.0, 1.0, 0.0)):
    """Returns view_from_world of a pose that looks along its -z."""
    eye, target = np.asarray(eye, float), np.asarray(target, float)
    back = (eye - target) / np.linalg.norm(eye - target)
    if abs(np.dot(back, up)) > 0.9999:
        up = (0.0, 0.0, 1.0)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    rows = np.array([right, np.cross(back, right), back])
    out = np.eye(4)
    out[:3, :3] = rows
    out[:3, 3] = -rows @ eye
    return out


def perspective(fov_y_deg, aspect, near, far):
    """Returns clip_from_view of OpenGL, depth from -1 to 1."""
    f = 1 / math.tan(math.radians(fov_y_deg) / 2)
    out = np.zeros((4, 4))
    out[0, 0], out[1, 1] = f / aspect, f
    out[2, 2], out[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far)
    out[3, 2] = -1
    return out


def orthographic(left, right, bottom, top, near, far):
    """Returns clip_from_view of OpenGL, depth from -1 to 1."""
    out = np.eye(4)
    out[0, 0], out[0, 3] = 2 / (right - left), -(right + left) / (right - left)
    out[1, 1], out[1, 3] = 2 / (top - bottom), -(top + bottom) / (top - bottom)
    out[2, 2], out[2, 3] = -2 / (far - near), -(far + near) / (far - near)
    return out


def direction(azimuth_deg, elevation_deg):
    """Returns the direction to a light, y up; azimuth 0 is +z and 90 is +x."""
    a, e = math.radians(azimuth_deg), math.radians(elevation_deg)
    return np.array([math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a)])


class Object:
    """Triangles of one object, in world space."""

    def __init__(self, name, positions, normals, indices, double_sided=False):
        self.name, self.double_sided = name, double_sided
        self.positions = np.asarray(positions, np.float32).reshape(-1, 3)
        self.normals = np.asarray(normals, np.float32).reshape(-1, 3)
        self.indices = np.asarray(indices, np.uint32).reshape(-1)


class ProofScene:
    """Objects with a camera and a light. Lengths in metres."""

    def __init__(self, name, title, objects, eye, target, fov_y_deg, to_light, resolution, size=(640, 360),
                 margin=1.02):
        self.name, self.title, self.objects = name, title, objects
        self.width, self.height = size
        self.resolution, self.fov_y_deg = resolution, fov_y_deg
        self.to_light = np.asarray(to_light, float) / np.linalg.norm(to_light)
        points = np.vstack([o.positions for o in objects]).astype(float)
        self.view_from_world = look_at(eye, target)
        depths = -(self.view_from_world[:3, :3] @ points.T + self.view_from_world[:3, 3:])[2]
        self.far_m = float(depths.max()) * 1.05
        self.near_m = max(0.02 * self.far_m / 10, 0.5 * float(depths.min()))
        self.clip_from_view = perspective(fov_y_deg, self.width / self.height, self.near_m, self.far_m)
        self.fit_light(points, margin)

    def fit_light(self, points, margin):
        """Makes a box around all objects, whose width and height are equal, and larger by a factor."""
        centre = (points.min(0) + points.max(0)) / 2
        radius = float(np.linalg.norm(points - centre, axis=1).max())
        distance = 1.5 * radius
        self.light_view_from_world = look_at(centre + distance * self.to_light, centre)
        seen = (self.light_view_from_world[:3, :3] @ points.T + self.light_view_from_world[:3, 3:])
        half = margin * float(np.abs(seen[:2]).max())
        room = 0.05 * radius
        self.box = {"left_m": -half, "right_m": half, "bottom_m": -half, "top_m": half,
                    "near_m": float(-seen[2].max()) - room, "far_m": float(-seen[2].min()) + room}

    def clip_from_world(self):
        """Returns the matrix of the light's box."""
        b = self.box
        return orthographic(b["left_m"], b["right_m"], b["bottom_m"], b["top_m"], b["near_m"],
                            b["far_m"]) @ self.light_view_from_world

    def camera_clip_from_world(self):
        """Returns the camera's matrix."""
        return self.clip_from_view @ self.view_from_world


def quad(name, corners, normal, double_sided=False):
    """Returns an object of two triangles, counterclockwise seen from the normal's side."""
    return Object(name, corners, [normal] * 4, [0, 1, 2, 0, 2, 3], double_sided)


def box(name, size, centre, turn_deg=0.0):
    """Returns a box that is turned about the vertical axis."""
    positions, normals, indices = [], [], []
    c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    for axis in range(3):
        for sign in (-1, 1):
            n = np.zeros(3)
            n[axis] = sign
            u = np.zeros(3)
            u[(axis + 1) % 3] = 1
            v = np.cross(n, u)
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                positions.append(turn @ ((n + a * u + b * v) * np.asarray(size) / 2) + centre)
                normals.append(turn @ n)
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    return Object(name, positions, normals, indices)


def box_scene():
    """Returns a plane with two boxes, and a plate whose back faces the light."""
    floor = quad("Floor", [(-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)], (0, 1, 0))
    # Normal down and away from the light: the light meets its back.
    plate = quad("Plate", [(-3.2, 1.4, -0.2), (-3.2, 1.0, -1.8), (-1.6, 1.0, -1.8), (-1.6, 1.4, -0.2)],
                 np.array([0, -1.6, 0.4]) / np.linalg.norm([1.6, 0.4]))
    objects = [floor, box("Box", (1.4, 1.4, 1.4), (0, 0.7, 0), 24), box("Low", (2.0, 0.4, 0.8), (2.4, 0.2, 1.2), -35),
               plate]
    return ProofScene("box", "plane and box", objects, (3.4, 4.2, 7.5), (0, 0.5, -0.2), 38, direction(-100, 40), 1024)


def tilted_plane(tilt_deg, diagonal):
    """Returns a plane that fills the picture, tilted against the light along an axis of the map or along its diagonal.

    Its corners lie on borders of texels of the scene's box, so that a rasteriser does not move them."""
    to_light = direction(30, 40)
    axes = look_at(to_light, (0, 0, 0))[:3, :3]
    tan = math.tan(math.radians(tilt_deg))
    slope = np.array([1, 1]) / math.sqrt(2) if diagonal else np.array([1, 0])
    normal = tan * (slope[0] * axes[0] + slope[1] * axes[1]) + axes[2]
    normal /= np.linalg.norm(normal)
    kHalf, kTexels, kCornerTexels = 4.0, 256, 120
    corners = [kHalf * (x * axes[0] + y * axes[1] - tan * (slope @ (x, y)) * axes[2])
               for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    name = f"plane-{tilt_deg:g}-{'diagonal' if diagonal else 'axis'}"
    u = np.cross(normal, axes[1])
    u /= np.linalg.norm(u)
    # Slightly oblique, so that no row of pixels follows a row of texels.
    eye = 3.2 * normal + 0.11 * u + 0.07 * np.cross(normal, u)
    return ProofScene(name, name, [quad("Plane", corners, normal)], eye, 0.05 * u, 55, to_light, kTexels, (320, 180),
                      margin=kTexels / 2 / kCornerTexels)


def read_glb(path):
    """Returns the objects of a glTF binary, placed in world space. Textures are left out."""
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    root = json.loads(data[20:20 + length])
    binary = data[28 + length:]
    kinds = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
    counts = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

    def accessor(index):
        a = root["accessors"][index]
        view = root["bufferViews"][a["bufferView"]]
        kind, count = np.dtype(kinds[a["componentType"]]), counts[a["type"]]
        stride = view.get("byteStride", kind.itemsize * count)
        at = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        rows = np.ndarray((a["count"], count), kind, binary, at, (stride, kind.itemsize))
        if kind.kind != "f" and a.get("normalized"):
            return rows.astype(np.float64) / np.iinfo(kind).max
        return rows.copy()

    def matrix_of(node):
        if "matrix" in node:
            return np.array(node["matrix"], float).reshape(4, 4).T
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        out = np.eye(4)
        out[:3, :3] = turn * np.asarray(node.get("scale", (1, 1, 1)), float)
        out[:3, 3] = node.get("translation", (0, 0, 0))
        return out

    objects = []

    def visit(index, above):
        node = root["nodes"][index]
        world = above @ matrix_of(node)
        mesh = root["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []
        for primitive in mesh:
            p = accessor(primitive["attributes"]["POSITION"]).astype(float)
            positions = p @ world[:3, :3].T + world[:3, 3]
            indices = accessor(primitive["indices"]).reshape(-1) if "indices" in primitive else np.arange(len(p))
            if np.linalg.det(world[:3, :3]) < 0:
                indices = indices.reshape(-1, 3)[:, ::-1].reshape(-1)
            if "NORMAL" in primitive["attributes"]:
                normals = accessor(primitive["attributes"]["NORMAL"]) @ np.linalg.inv(world[:3, :3])
                normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-20)
            else:
                corners = positions[indices].reshape(-1, 3, 3)
                face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
                face /= np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-20)
                positions, normals = corners.reshape(-1, 3), np.repeat(face, 3, 0)
                indices = np.arange(len(positions))
            material = root.get("materials", [{}])[primitive.get("material", 0)] if root.get("materials") else {}
            objects.append(Object(node.get("name", f"node {index}"), positions, normals, indices,
                                  material.get("doubleSided", False)))
        for child in node.get("children", []):
            visit(child, world)

    for node in root["scenes"][root.get("scene", 0)]["nodes"]:
        visit(node, np.eye(4))
    return objects


def write_glb(path, objects):
    """Writes objects as a glTF binary, without a transform, so that positions are the same numbers everywhere."""
    views, accessors, meshes, nodes, chunks, size = [], [], [], [], [], 0

    def add(array, kind, component, target):
        nonlocal size
        raw = array.tobytes()
        views.append({"buffer": 0, "byteOffset": size, "byteLength": len(raw), "target": target})
        row = {"bufferView": len(views) - 1, "componentType": component, "type": kind,
               "count": len(array) if kind != "SCALAR" else array.size}
        if kind == "VEC3":
            row["min"], row["max"] = array.min(0).tolist(), array.max(0).tolist()
        accessors.append(row)
        chunks.append(raw + b"\0" * (-len(raw) % 4))
        size += len(chunks[-1])
        return len(accessors) - 1

    for i, o in enumerate(objects):
        primitive = {"attributes": {"POSITION": add(o.positions, "VEC3", 5126, 34962),
                                    "NORMAL": add(o.normals, "VEC3", 5126, 34962)},
                     "indices": add(o.indices, "SCALAR", 5125, 34963), "material": int(o.double_sided)}
        meshes.append({"primitives": [primitive]})
        nodes.append({"name": f"{i} {o.name}".replace("/", "_"), "mesh": i})
    white = {"pbrMetallicRoughness": {"metallicFactor": 0}}
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
            "meshes": meshes, "materials": [white, {**white, "doubleSided": True}], "accessors": accessors,
            "bufferViews": views, "buffers": [{"byteLength": size}]}
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(chunks)
    with open(path, "wb") as file:
        file.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)
