# Draws jobs in Godot 3: each argument behind "--jobs" is a folder. The mask is the light's ATTENUATION, which a shader's
# own light() writes as it is: no colour, no N·L, no tone mapping. Godot fits the map by itself; fitted() repeats that of
# VisualServerScene::_light_instance_update_shadow for one split, in the same single precision.
extends Node

const SURFACE = """
shader_type spatial;
render_mode ambient_light_disabled, specular_disabled, %s;
void fragment() { ALBEDO = vec3(1.0); ROUGHNESS = 1.0; }
void light() { DIFFUSE_LIGHT += ATTENUATION; }
"""

const FILTERS = ["Disabled", "PCF5", "PCF13"]

func _ready():
	var jobs = []
	for argument in OS.get_cmdline_args():
		if argument.begins_with("--jobs="):
			jobs = Array(argument.substr(len("--jobs=")).split(":"))
	for folder in jobs:
		yield(draw(folder), "completed")
	get_tree().quit()

func floats_of(path):
	var file = File.new()
	if file.open(path, File.READ) != OK:
		OS.exit_code = 1
		printerr(path + ": cannot be read")
		get_tree().quit()
	var stream = StreamPeerBuffer.new()
	stream.data_array = file.get_buffer(file.get_len())
	var out = []
	for _i in range(file.get_len() / 4):
		out.append(stream.get_float())
	return out

func integers_of(path):
	var file = File.new()
	file.open(path, File.READ)
	var out = []
	for _i in range(file.get_len() / 4):
		out.append(file.get_32())
	return out

func pose_of(view):
	# The inverse of a column-major rotation and translation.
	var basis = Basis(Vector3(view[0], view[4], view[8]), Vector3(view[1], view[5], view[9]),
			Vector3(view[2], view[6], view[10]))
	return Transform(basis, -(basis.xform(Vector3(view[12], view[13], view[14]))))

func surface(double_sided, receives):
	var modes = "cull_disabled" if double_sided else "cull_back"
	if not receives:
		modes += ", shadows_disabled"
	var shader = Shader.new()
	shader.code = SURFACE % modes
	var material = ShaderMaterial.new()
	material.shader = shader
	return material

func mesh_of(object, positions, normals, indices):
	# Indices of the object's own vertices. Godot's front faces are clockwise.
	var first = indices[object.first_index]
	var last = first
	for k in range(object.first_index, object.first_index + object.index_count):
		first = min(first, indices[k])
		last = max(last, indices[k])
	var order = PoolIntArray()
	for k in range(object.first_index, object.first_index + object.index_count, 3):
		order.append(indices[k] - first)
		order.append(indices[k + 2] - first)
		order.append(indices[k + 1] - first)
	var vertices = PoolVector3Array()
	var directions = PoolVector3Array()
	for k in range(3 * first, 3 * (last + 1), 3):
		vertices.append(Vector3(positions[k], positions[k + 1], positions[k + 2]))
		directions.append(Vector3(normals[k], normals[k + 1], normals[k + 2]))
	var arrays = []
	arrays.resize(ArrayMesh.ARRAY_MAX)
	arrays[ArrayMesh.ARRAY_VERTEX] = vertices
	arrays[ArrayMesh.ARRAY_NORMAL] = directions
	arrays[ArrayMesh.ARRAY_INDEX] = order
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0)
	return mesh

# Returns true when a box lies on the inner side of all planes, or crosses them.
func touches(box, planes):
	for plane in planes:
		var nearest = Vector3(
				box.position.x if plane.normal.x > 0 else box.end.x,
				box.position.y if plane.normal.y > 0 else box.end.y,
				box.position.z if plane.normal.z > 0 else box.end.z)
		if plane.distance_to(nearest) > 0:
			return false
	return true

# Returns the box that Godot fits: half width, depth and clip_from_world.
func fitted(camera, light, aspect, texels, boxes):
	var far = min(light.directional_shadow_max_distance, camera.far)
	# Godot takes the camera's horizontal angle as the vertical one here, so that the box is wider than the view needs.
	var tangent = tan(deg2rad(camera.fov) / 2) * aspect
	var corners = []
	for distance in [camera.near, far]:
		for x in [-1.0, 1.0]:
			for y in [-1.0, 1.0]:
				corners.append(camera.global_transform.xform(
						Vector3(x * tangent * aspect * distance, y * tangent * distance, -distance)))
	var axes = light.global_transform.basis.orthonormalized()
	var x_axis = axes.x
	var y_axis = axes.y
	var z_axis = axes.z
	var centre = Vector3()
	for corner in corners:
		centre += corner
	centre /= 8.0
	var radius = 0.0
	var low = Vector3(INF, INF, INF)
	var high = -low
	for corner in corners:
		radius = max(radius, centre.distance_to(corner))
		var at = Vector3(x_axis.dot(corner), y_axis.dot(corner), z_axis.dot(corner))
		low = Vector3(min(low.x, at.x), min(low.y, at.y), min(low.z, at.z))
		high = Vector3(max(high.x, at.x), max(high.y, at.y), max(high.z, at.z))
	radius *= texels / (texels - 2.0)
	var unit = radius * 2.0 / texels
	var x_max = stepify(x_axis.dot(centre) + radius, unit)
	var x_min = stepify(x_axis.dot(centre) - radius, unit)
	var y_max = stepify(y_axis.dot(centre) + radius, unit)
	var y_min = stepify(y_axis.dot(centre) - radius, unit)
	var z_min = z_axis.dot(centre) - radius
	var planes = [Plane(x_axis, high.x), Plane(-x_axis, -low.x), Plane(y_axis, high.y), Plane(-y_axis, -low.y),
			Plane(z_axis, high.z + 1e6), Plane(-z_axis, -low.z)]
	var z_max = high.z
	for box in boxes:
		if touches(box, planes):
			for k in range(8):
				z_max = max(z_max, z_axis.dot(box.get_endpoint(k)))
	var half = Vector2((x_max - x_min) / 2, (y_max - y_min) / 2)
	var depth = z_max - z_min
	var middle = Vector2(x_min + half.x, y_min + half.y)
	# Columns: x and y over the half widths, z from -1 at z_max to 1 at z_max - depth.
	var matrix = []
	for k in range(3):
		matrix += [x_axis[k] / half.x, y_axis[k] / half.y, -2 * z_axis[k] / depth, 0]
	matrix += [-middle.x / half.x, -middle.y / half.y, 2 * z_max / depth - 1, 1]
	return {"width_m": 2 * half.x, "height_m": 2 * half.y, "depth_m": depth, "clip_from_world": matrix}

func draw(folder):
	var file = File.new()
	if file.open(folder + "/job.json", File.READ) != OK:
		OS.exit_code = 1
		printerr(folder + "/job.json: cannot be read")
		get_tree().quit()
		yield(get_tree(), "idle_frame")
		return
	var job = parse_json(file.get_as_text())
	var parameters = job.get("parameters", {})
	var positions = floats_of(folder + "/" + job.positions)
	var normals = floats_of(folder + "/" + job.normals)
	var indices = integers_of(folder + "/" + job.indices)
	var size = Vector2(job.camera.width, job.camera.height)
	ProjectSettings.set_setting("rendering/quality/shadows/filter_mode",
			FILTERS.find(parameters.get("filter_mode", "Disabled")))

	var viewport = Viewport.new()
	viewport.size = size
	viewport.own_world = true
	viewport.hdr = true
	viewport.keep_3d_linear = true
	viewport.usage = Viewport.USAGE_3D
	viewport.shadow_atlas_size = 256  # 0, the default of made viewports, turns all shadows off
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	viewport.render_target_v_flip = true
	add_child(viewport)
	var environment = Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(1, 1, 1)
	var world_environment = WorldEnvironment.new()
	world_environment.environment = environment
	viewport.add_child(world_environment)

	var boxes = []
	for object in job.objects:
		var instance = MeshInstance.new()
		instance.mesh = mesh_of(object, positions, normals, indices)
		instance.material_override = surface(object.double_sided, object.receives)
		instance.cast_shadow = (GeometryInstance.SHADOW_CASTING_SETTING_ON if object.casts
				else GeometryInstance.SHADOW_CASTING_SETTING_OFF)
		viewport.add_child(instance)
		if object.casts:
			boxes.append(instance.mesh.get_aabb())

	var camera = Camera.new()
	camera.set_perspective(job.camera.fov_y_deg, job.camera.near_m, job.camera.far_m)
	viewport.add_child(camera)
	camera.global_transform = pose_of(job.camera.view_from_world)
	camera.current = true

	var light = DirectionalLight.new()
	viewport.add_child(light)
	light.global_transform = pose_of(job.light.view_from_world)
	light.shadow_enabled = true
	light.directional_shadow_mode = DirectionalLight.SHADOW_ORTHOGONAL
	light.directional_shadow_depth_range = DirectionalLight.SHADOW_DEPTH_RANGE_STABLE
	for name in ["shadow_bias", "directional_shadow_normal_bias", "directional_shadow_bias_split_scale",
			"directional_shadow_max_distance"]:
		if parameters.has(name):
			light.set(name, parameters[name])
	light.shadow_reverse_cull_face = str(parameters.get("shadow_reverse_cull_face", "false")).to_lower() == "true"

	for _frame in range(3):
		yield(get_tree(), "idle_frame")
	yield(VisualServer, "frame_post_draw")
	var image = viewport.get_texture().get_data()
	image.convert(Image.FORMAT_L8)
	var out = File.new()
	out.open(folder + "/mask.pgm", File.WRITE)
	out.store_string("P5\n%d %d\n255\n" % [size.x, size.y])
	out.store_buffer(image.get_data())
	out.close()
	var texels = int(ProjectSettings.get_setting("rendering/quality/directional_shadow/size"))
	var facts = fitted(camera, light, size.x / size.y, texels, boxes)
	var version = Engine.get_version_info()
	facts["engine"] = "Godot"
	facts["version"] = "%d.%d.%d" % [version.major, version.minor, version.patch]
	facts["map_resolution"] = texels
	facts["map_format"] = "depth24"
	out.open(folder + "/facts.json", File.WRITE)
	# JSON.print() writes six digits.
	var numbers = PoolStringArray()
	for number in facts.clip_from_world:
		numbers.append("%.12f" % number)
	facts.erase("clip_from_world")
	var text = JSON.print(facts, " ").strip_edges().trim_suffix("}").strip_edges()
	out.store_string(text + ",\n \"clip_from_world\": [" + numbers.join(", ") + "]\n}\n")
	out.close()
	viewport.queue_free()
	yield(get_tree(), "idle_frame")
