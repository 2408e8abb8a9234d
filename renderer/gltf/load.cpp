// load_gltf() and the order of its steps.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/gltf/decompress.h"
#include "renderer/gltf/extras.h"
#include "renderer/gltf/not_written.h"
#include "renderer/gltf/rig.h"
#include "renderer/gltf/rules.h"
#include "renderer/scene/axes.h"
#include "renderer/scene/main_part.h"
#include "renderer/scene/scene_lights.h"
#include "renderer/settings/settings.h"

namespace si {
namespace gltf {
namespace {

std::string about(const Json& root) {
    const auto& asset = root["asset"];
    const auto text = [&](const char* key) { return printable(text_member(asset, key), 120); };
    std::string out = fmt::format("glTF {}", text("version"));
    if (const std::string generator = text("generator"); !generator.empty())
        out += fmt::format(", written by {}", generator);
    if (const std::string copyright = text("copyright"); !copyright.empty()) out += fmt::format(". {}", copyright);
    return out;
}

/// Refuses buffers and images in files: a converted model holds all its bytes.
void refuse_files(const Context& context, const Json& root) {
    for (const char* list : {"buffers", "images"}) {
        const auto found = root.find(list);
        if (found == root.end()) continue;
        for (std::size_t i = 0; i < found->size(); ++i)
            if (const Json& entry = (*found)[i]; entry.is_object() && entry.contains("uri"))
                context.fail(Place(list, i), "names a file, which no converted model may");
    }
}

/// @param converted true: the bytes were made by an importer
void load(Context& context, std::span<const std::uint8_t> bytes, bool converted, Scene& scene) {
    const Container container = split_container(context, bytes);
    Json root = parse_json(context, container.json);
    check_asset_and_extensions(context, root);
    scene.not_written = parts_not_written(root);
    check_arrays(context, root);
    Buffers buffers(context, root, container);
    decompress(context, root, buffers);
    const Sizes sizes = check_arrays(context, root);
    check_data(context, root, sizes);
    check_graph(context, root, sizes);
    check_look(context, root, sizes);
    const tinygltf::Model model = read_model(context, root);
    scene.about = about(root);
    if (converted) {
        refuse_files(context, root);
        read_importer_extras(context, root, scene);
    }
    read_scene_extras(context, root, context.options().file.scene, scene);

    Accessors accessors(context, model, buffers);
    Textures textures(context, root, model, buffers, scene);
    Materials materials(context, root, model, textures, scene);
    Primitives primitives(context, model, accessors, materials, scene);
    const PlacedNodes placed =
        place_nodes(context, root, model, accessors, primitives, context.options().file.scene, scene);
    add_rig(context, root, model, accessors, primitives, placed, scene);
    if (const auto& world = context.options().world)
        apply_world(scene, *world);
    else
        apply_file_choices(scene, context.options().file);
    if (converted || scene.file_up != UpAxis::Y || scene.file_unit_m != 1)
        scene.about += fmt::format("; read as {} up, {:g} m a unit", up_axis_key(scene.file_up), scene.file_unit_m);
    textures.decode();
    make_full_blends_opaque(context, root, scene);
    if (scene.objects.empty()) context.warn("the file has no triangles to show");
    if (scene.lights.size() > std::size_t(kMaxLights)) {
        context.warn(fmt::format("the file has {} lights, the first {} can be used", scene.lights.size(), kMaxLights));
    }
}

}  // namespace
}  // namespace gltf

namespace {

/// Suggests that blended surfaces cast shadows by their alpha mask, where they are a large part of the scene: blended
/// foliage would otherwise cast none.
void suggest_casters(Scene& scene) {
    constexpr std::string_view kKey = "caster.blend";
    if (std::ranges::any_of(scene.suggested, [&](const auto& row) { return row.first == kKey; })) return;
    double blended = 0, all = 0;  // areas
    for (const Object& o : scene.objects) {
        const Mesh& mesh = scene.meshes[std::size_t(o.mesh)];
        double area = 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
                c(mesh.positions[mesh.indices[i + 2]]);
            const glm::dmat3 turn(o.world);
            area += glm::length(glm::cross(turn * (b - a), turn * (c - a)));
        }
        all += area;
        if (mesh.material < 0) continue;
        const Material& m = scene.materials[std::size_t(mesh.material)];
        if (m.alpha == AlphaMode::Blend && m.base_colour_texture >= 0) blended += area;
    }
    if (2 * blended > all) scene.suggested.emplace_back(kKey, "mask");
}

/// Notes objects far from the rest and a scene that looks z-up. Fits that hold all casters would waste their maps on
/// the way to far objects, so the view frustum is suggested. An up axis that the user has chosen is not questioned.
void describe_placement(Scene& scene, const FileChoices& choices) {
    set_main_part(scene);
    scene.far_objects = far_objects_text(scene);
    if (!scene.far_objects.empty()) {
        scene.warnings.push_back(fmt::format(
            "{}; the first picture frames the rest, and light.fit starts as view; camera.index=-1 frames all",
            scene.far_objects));
        const auto is_fit = [](const auto& row) { return row.first.ends_with(".fit"); };
        if (std::ranges::none_of(scene.suggested, is_fit))
            for (std::size_t i = 0; i < std::clamp<std::size_t>(scene.lights.size(), 1, kMaxLights); ++i)
                scene.suggested.emplace_back(fmt::format("light.{}.fit", i), "view");
    }
    scene.looks_z_up = choices.up == UpAxis::File && looks_z_up(scene);
    if (scene.looks_z_up)
        scene.warnings.push_back(
            "the scene looks z-up: it is low, and stands on a plane along z; --set scene.up=z turns it");
}

/// Completes a scene that `read` fills, and turns exceptions of libraries into errors that name the file.
template <typename Read>
Scene load_with(const std::filesystem::path& path, const GltfOptions& options, const Read& read) {
    Scene scene;
    scene.name = path.string();
    gltf::Context context(path, options, scene.warnings);
    try {
        read(context, scene);
        context.close_warnings();
        scene.files = context.take_files();
        context.progress(0.95);
        finalise(scene);
        // Exported light settings that the user changed take precedence over those that the lights suggest.
        const auto of_lights = [](const auto& row) { return row.first.starts_with("light."); };
        if (std::ranges::none_of(scene.suggested, of_lights)) suggest_lights(scene);
        suggest_casters(scene);
        FileChoices choices = options.file;
        if (options.world) choices.up = UpAxis::Y;
        describe_placement(scene, choices);
    } catch (const std::bad_alloc&) {
        context.fail("there is not enough memory to load it", "free some memory or use a smaller model");
    } catch (const gltf::Json::exception& error) {
        context.fail(error.what(), "repair the file or export it again");
    }
    context.progress(1);
    return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options) {
    return load_with(path, options, [](gltf::Context& context, Scene& scene) {
        context.note_file(context.path());
        const gltf::ReadResult file = gltf::read_regular_file(context.path(), context.options().max_file_bytes,
                                                              [&](double part) { context.progress(0.4 * part); });
        if (!file.error.empty()) context.fail(file.error, "give the path of a .gltf or .glb file");
        gltf::load(context, file.bytes.span(), false, scene);
    });
}

Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                      const GltfOptions& options) {
    return load_with(path, options,
                     [&](gltf::Context& context, Scene& scene) { gltf::load(context, bytes, false, scene); });
}

Scene load_converted(std::span<const std::uint8_t> glb, const std::filesystem::path& path, const GltfOptions& options) {
    return load_with(path, options, [&](gltf::Context& context, Scene& scene) {
        context.note_file(path);
        gltf::load(context, glb, true, scene);
    });
}

}  // namespace si
