# Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
#
# Example: a bundle from Godot 4. Excerpt to copy from; it is run by no test.
#
# Godot's own shadow atlases cannot be read by scripts: RenderingServer gives no texture of them. Two ways are left:
# - A capture by RenderDoc, which `shadow-inspector import-capture` opens. It has the atlas, all matrices and all states.
# - A map of your own, drawn by an orthographic Camera3D in a SubViewport with a material that writes depth to colour. The
#   bundle then shows this map, not Godot's. The code below does that.
#
# Traps of Godot:
# - The world is right-handed, y up, in metres, as in glTF. A DirectionalLight3D shines along its -z axis.
# - From 4.3 depth is reversed in Forward+ and Mobile. Camera3D.get_camera_projection() is still of -1 to 1, not
#   reversed: it is the projection before the renderer corrects it.
# - Image.get_data() has the top row first.
# - Projection and Transform3D are by columns: projection.x is the first column.
# - A viewport of 8 bits a channel is no depth map. use_hdr_2d makes it half floats, which hold depth to a 2000th. The
#   shader below therefore spreads depth over two channels. Its environment has no tone mapping and no glow.
# - Bias of Godot's lights (shadow_bias, shadow_normal_bias) acts in its own look-up, which this map does not go through.
extends Node

@export var light: DirectionalLight3D
@export var viewport: SubViewport  ## square, with an orthographic Camera3D, transparent_bg and use_hdr_2d on
@export var view: Camera3D
@export var folder := "user://frame.bundle"

## Material for GeometryInstance3D.material_override of all casters while the map is drawn.
const DEPTH_SHADER := "
shader_type spatial;
render_mode unshaded, fog_disabled;
uniform float near;
uniform float far;
void fragment() {
    float share = clamp((-VERTEX.z - near) / (far - near), 0.0, 1.0) * 1024.0;
    // Whole 1024ths in red, the rest in green: both are exact in half floats.
    ALBEDO = vec3(floor(share) / 1024.0, fract(share), 0.0);
}"


func write_bundle() -> void:
    var camera := viewport.get_camera_3d()
    await RenderingServer.frame_post_draw
    DirAccess.make_dir_recursive_absolute(folder)

    # The scene. Godot writes glTF itself.
    var document := GLTFDocument.new()
    var state := GLTFState.new()
    document.append_from_scene(get_tree().current_scene, state)
    document.write_to_filesystem(state, folder.path_join("scene.glb"))

    # The map: linear depth, 0 at the near plane, 1 at the far plane. Texels without a caster get 1.
    var image := viewport.get_texture().get_image()
    var depths := PackedFloat32Array()
    for y in image.get_height():
        for x in image.get_width():
            var texel := image.get_pixel(x, y)
            var covered := texel.a > 0.5
            depths.append(texel.r + texel.g / 1024.0 if covered else 1.0)
    var map := FileAccess.open(folder.path_join("sun.raw"), FileAccess.WRITE)
    map.store_buffer(depths.to_byte_array())
    map.close()

    var direction := -light.global_transform.basis.z
    var frame := {
        "bundle": 1,
        "made_by": "Godot " + Engine.get_version_info().string,
        "scene": "scene.glb",
        "camera": {
            "clip_from_world": clip_from_world(view),
            "width": view.get_viewport().size.x,
            "height": view.get_viewport().size.y,
            "depth": {"range": "-1..1", "reversed": false},
        },
        "lights": [{
            "name": light.name,
            "type": "directional",
            "direction": [direction.x, direction.y, direction.z],
            "maps": [{
                "image": {"file": "sun.raw", "format": "f32", "width": image.get_width(),
                          "height": image.get_height(), "first_row": "top"},
                "clip_from_world": clip_from_world(camera),
                "depth": {"range": "-1..1", "reversed": false, "stored": "linear", "format": "r32f"},
            }],
            # No look-up reads this map in Godot, so nothing is stated.
            "lookup": {},
        }],
        "notes": ["The map is drawn by a camera of the scene. It is not Godot's own shadow map."],
    }
    # frame.json comes last: a folder without it is no bundle. Full precision keeps all digits of a float.
    var part := FileAccess.open(folder.path_join("frame.json.part"), FileAccess.WRITE)
    part.store_string(JSON.stringify(frame, " ", true, true))
    part.close()
    DirAccess.rename_absolute(folder.path_join("frame.json.part"), folder.path_join("frame.json"))


## Returns the matrix of a camera as 16 numbers, by columns.
func clip_from_world(camera: Camera3D) -> Array:
    var matrix := camera.get_camera_projection() * Projection(camera.global_transform.affine_inverse())
    var numbers := []
    for column in [matrix.x, matrix.y, matrix.z, matrix.w]:
        numbers.append_array([column.x, column.y, column.z, column.w])
    return numbers
