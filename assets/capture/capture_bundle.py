"""Files of a bundle: scene.glb, maps, picture, frame.json."""
import json
import os
import struct
import zlib

import numpy as np


def write_png(path, rgb):
    """Writes a (row, column, 3) array of bytes, top row first."""
    height, width = rgb.shape[:2]
    rows = b"".join(b"\0" + rgb[y].tobytes() for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(png_bytes_of(rows, width, height, 2, chunk))


def png_bytes_of(rows, width, height, colour, chunk):
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)) + \
        chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b"")


def rgba_png(pixels):
    """Returns the bytes of a PNG of a (row, column, 4) array of bytes, top row first."""
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + pixels[y].tobytes() for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return png_bytes_of(rows, width, height, 6, chunk)


class Scene:
    """Meshes and nodes of scene.glb."""

    def __init__(self):
        self.binary = bytearray()
        self.views = []
        self.accessors = []
        self.meshes = []
        self.materials = []
        self.material_keys = {}
        self.nodes = []
        self.mesh_keys = {}
        self.images = []

    def view(self, data, target=None):
        while len(self.binary) % 4:
            self.binary.append(0)
        entry = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            entry["target"] = target
        self.views.append(entry)
        self.binary += data
        return len(self.views) - 1

    def accessor(self, values, kind, component, target, bounds=False):
        entry = {"bufferView": self.view(values.tobytes(), target), "componentType": component,
                 "count": len(values), "type": kind}
        if bounds:
            entry["min"] = [float(v) for v in values.min(0)]
            entry["max"] = [float(v) for v in values.max(0)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def material(self, double_sided, mask=None):
        """@param mask (key, PNG bytes, cutoff)"""
        key = (double_sided, mask[0] if mask else None, mask[2] if mask else None)
        if key not in self.material_keys:
            entry = {"doubleSided": bool(double_sided),
                     "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0,
                                              "roughnessFactor": 1}}
            if mask:
                entry["alphaMode"] = "MASK"
                entry["alphaCutoff"] = mask[2]
                self.images.append({"bufferView": self.view(mask[1]), "mimeType": "image/png"})
                entry["pbrMetallicRoughness"]["baseColorTexture"] = {"index": len(self.images) - 1}
            self.material_keys[key] = len(self.materials)
            self.materials.append(entry)
        return self.material_keys[key]

    def mesh(self, key, positions, triangles, material, uv=None, normals=None):
        key = (key, material)
        if key not in self.mesh_keys:
            used, triangles = np.unique(triangles, return_inverse=True)
            attributes = {"POSITION": self.accessor(positions[used].astype("<f4"), "VEC3", 5126, 34962, True)}
            if uv is not None:
                attributes["TEXCOORD_0"] = self.accessor(uv[used].astype("<f4"), "VEC2", 5126, 34962)
            if normals is not None:
                attributes["NORMAL"] = self.accessor(normals[used].astype("<f4"), "VEC3", 5126, 34962)
            index = self.accessor(triangles.reshape(-1, 1).astype("<u4"), "SCALAR", 5125, 34963)
            self.meshes.append({"primitives": [{"attributes": attributes, "indices": index, "material": material}]})
            self.mesh_keys[key] = len(self.meshes) - 1
        return self.mesh_keys[key]

    def node(self, name, mesh, matrix):
        entry = {"name": name, "mesh": mesh}
        if not np.array_equal(matrix, np.eye(4)):
            entry["matrix"] = [float(v) for v in matrix.T.ravel()]
        self.nodes.append(entry)

    def write(self, path):
        model = {"asset": {"version": "2.0", "generator": "Shadow Inspector, import-capture"}, "scene": 0,
                 "scenes": [{"nodes": list(range(len(self.nodes)))}], "nodes": self.nodes, "meshes": self.meshes,
                 "materials": self.materials, "accessors": self.accessors, "bufferViews": self.views,
                 "buffers": [{"byteLength": len(self.binary)}]}
        if self.images:
            model["images"] = self.images
            model["samplers"] = [{}]
            model["textures"] = [{"source": i, "sampler": 0} for i in range(len(self.images))]
        text = json.dumps(model, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(binary)))
            file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)


def columns(matrix):
    return [float(v) for v in np.asarray(matrix).T.ravel()]


def write_raw(path, values):
    with open(path, "wb") as file:
        file.write(np.ascontiguousarray(values).tobytes())


def write_json(folder, frame):
    with open(os.path.join(folder, "frame.json"), "w") as file:
        json.dump(frame, file, indent=1, allow_nan=False)
        file.write("\n")
