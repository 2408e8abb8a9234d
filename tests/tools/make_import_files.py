"""Writes the models of tests/data/import that Blender exports, each beside its glTF twin.

Run: blender -b --factory-startup --python tests/tools/make_import_files.py -- FOLDER
Needs Blender 3.4 with its exporters of glTF (python3-numpy), FBX, COLLADA, OBJ, PLY, STL and X3D.
"""

import math
import os
import re
import sys

import bpy

FOLDER = sys.argv[sys.argv.index("--") + 1]


def path(name):
    return os.path.join(FOLDER, name)


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def mesh_object(name, vertices, faces, parent=None, uvs=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    if uvs:
        layer = mesh.uv_layers.new(name="UVMap")
        for loop, uv in zip(layer.data, uvs):
            loop.uv = uv
    mesh.update()
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    made.parent = parent
    return made


def block(name, size, parent=None):
    x, y, z = (s / 2 for s in size)
    vertices = [(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return mesh_object(name, vertices, faces, parent)


def colour_material(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*colour, 1)
    material.diffuse_color = (*colour, 1)
    return material


def mask_image():
    """A 16 x 16 picture of bars: every second pair of columns is transparent."""
    image = bpy.data.images.new("bars", 16, 16, alpha=True)
    pixels = []
    for _y in range(16):
        for x in range(16):
            pixels += [0.2, 0.6, 0.2, 1.0 if x // 2 % 2 == 0 else 0.0]
    image.pixels = pixels
    image.filepath_raw = path("bars.png")
    image.file_format = "PNG"
    image.save()
    image.source = "FILE"
    return image


def mask_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes["Principled BSDF"]
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = mask_image()
    tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(texture.outputs["Alpha"], shader.inputs["Alpha"])
    material.blend_method = "CLIP"
    material.use_backface_culling = True
    return material


def add_camera_and_lights():
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Eye", bpy.data.cameras.new("Eye"))
    camera.location = (4, -6, 3)
    camera.rotation_euler = (math.radians(70), 0, math.radians(35))
    camera.data.angle = math.radians(50)
    camera.data.clip_start = 0.25
    camera.data.clip_end = 120
    scene.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (math.radians(40), 0, math.radians(-60))
    scene.collection.objects.link(sun)
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "SPOT"))
    lamp.data.energy = 200
    lamp.data.spot_size = math.radians(60)
    lamp.data.spot_blend = 0.2
    lamp.location = (-2, 1, 4)
    lamp.rotation_euler = (math.radians(20), math.radians(-25), 0)
    scene.collection.objects.link(lamp)
    scene.render.resolution_x = 1600
    scene.render.resolution_y = 900


def make_scene():
    """Base, Lid on it (turned, scaled), Fence with a mask, a camera and two lights. 26 triangles, z up, metres."""
    empty_scene()
    base = block("Base", (2, 1, 0.5))
    base.location = (0.5, 0.25, 0.25)
    base.rotation_euler = (0, 0, math.radians(30))
    base.data.materials.append(colour_material("Red", (0.8, 0.1, 0.05)))
    lid = block("Lid", (1, 1, 0.1), base)
    lid.location = (0.5, 0, 0.4)
    lid.rotation_euler = (0, math.radians(-20), 0)
    lid.scale = (1.5, 0.5, 2)
    lid.data.materials.append(colour_material("Blue", (0.05, 0.1, 0.8)))
    fence = mesh_object("Fence", [(-1.5, 0, 0), (1.5, 0, 0), (1.5, 0, 1), (-1.5, 0, 1)], [(0, 1, 2, 3)],
                        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)])
    fence.location = (0, 1.5, 0)
    fence.data.materials.append(mask_material("Bars"))
    add_camera_and_lights()


def make_skinned():
    """A bar of two bones along z, bent by 60 degrees at its middle: the rest pose of an exported file is bent too."""
    empty_scene()
    armature = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    lower = armature.data.edit_bones.new("Lower")
    lower.head, lower.tail = (0, 0, 0), (0, 0, 1)
    upper = armature.data.edit_bones.new("Upper")
    upper.head, upper.tail = (0, 0, 1), (0, 0, 2)
    upper.parent = lower
    bpy.ops.object.mode_set(mode="OBJECT")
    vertices = [(0.1 * i, 0.1 * j, k) for k in (0, 0.5, 1, 1.5, 2) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    faces = [(0, 3, 2, 1), (16, 17, 18, 19)]
    for ring in range(4):
        for side in range(4):
            a, b = ring * 4 + side, ring * 4 + (side + 1) % 4
            faces.append((a, b, b + 4, a + 4))
    bar = mesh_object("Bar", vertices, faces, armature)
    bar.data.materials.append(colour_material("Grey", (0.5, 0.5, 0.5)))
    weights = {"Lower": [1, 1, 0.5, 0, 0], "Upper": [0, 0, 0.5, 1, 1]}
    for bone, by_ring in weights.items():
        group = bar.vertex_groups.new(name=bone)
        for ring, weight in enumerate(by_ring):
            if weight > 0:
                group.add(list(range(ring * 4, ring * 4 + 4)), weight, "REPLACE")
    modifier = bar.modifiers.new("Armature", "ARMATURE")
    modifier.object = armature
    bone = armature.pose.bones["Upper"]
    bone.rotation_mode = "XYZ"
    bone.rotation_euler = (math.radians(60), 0, 0)
    bpy.context.view_layer.update()


def export_gltf(name):
    bpy.ops.export_scene.gltf(filepath=path(name), export_format="GLB", export_cameras=True, export_lights=True,
                              export_animations=False, export_current_frame=True)


def export_scene(animated):
    bpy.ops.export_scene.fbx(filepath=path("scene.fbx" if not animated else "skinned.fbx"), path_mode="STRIP",
                             bake_anim=False, add_leaf_bones=False)
    bpy.ops.wm.collada_export(filepath=path("scene.dae" if not animated else "skinned.dae"), use_texture_copies=True,
                              include_animations=False)


def edit(name, pattern, replacement):
    """Replaces the one match of a pattern in a text file, and removes the time of writing."""
    with open(path(name), encoding="utf-8") as file:
        text = file.read()
    text, count = re.subn(pattern, replacement, text, flags=re.DOTALL)
    if count != 1:
        raise RuntimeError(f"{name}: {count} places match {pattern}")
    text = re.sub(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d", "2000-01-01T00:00:00", text)
    with open(path(name), "w", encoding="utf-8") as file:
        file.write(text)


def edit_collada():
    """Blender's COLLADA has no opacity of textures, and bones in bind pose: both are added."""
    edit("scene.dae", r'(<diffuse>\s*)(<texture[^>]*/>)(\s*</diffuse>)',
         r'\1\2\3\n            <transparent opaque="A_ONE">\2</transparent>')
    bent = "1 0 0 0 0 0.5 -0.8660254 1 0 0.8660254 0.5 0 0 0 0 1"
    edit("skinned.dae", r'(name="Upper" sid="Upper" type="JOINT">\s*<matrix sid="transform">)[^<]*', r"\g<1>" + bent)


os.makedirs(FOLDER, exist_ok=True)
make_scene()
export_gltf("scene.glb")
export_scene(False)
bpy.ops.wm.obj_export(filepath=path("scene.obj"), path_mode="STRIP", export_animation=False)
bpy.ops.export_mesh.ply(filepath=path("scene.ply"), use_ascii=False)
bpy.ops.export_mesh.stl(filepath=path("scene.stl"), ascii=False)
bpy.data.objects.remove(bpy.data.objects["Lamp"])  # the exporter of 3.4 fails on spot lights
bpy.ops.export_scene.x3d(filepath=path("scene.x3d"), path_mode="STRIP", axis_forward="-Z", axis_up="Y")
make_skinned()
export_gltf("skinned.glb")
export_scene(True)
edit_collada()
