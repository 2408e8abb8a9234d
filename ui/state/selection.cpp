#include "ui/state/selection.h"

#include <algorithm>
#include <cmath>

#include "renderer/settings/param.h"

namespace si {
namespace {

int node_of(const Scene& scene, const std::string& path) {
    if (path.empty()) return -1;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].path == path) return int(i);
    return -1;
}

/// Returns the bounds of a node's mesh in the node's own coordinates.
Bounds local_bounds(const Scene& scene, int node) {
    Bounds all;
    for (const Object* o : all_objects(scene))
        if (o->node == node) all.add(scene.meshes[std::size_t(o->mesh)].bounds.transformed(o->instance));
    return all;
}

/// Marks each node that is this one or below it.
std::vector<char> below(const Scene& scene, int node) {
    std::vector<char> in(scene.nodes.size(), 0);
    if (node < 0) return in;
    in[std::size_t(node)] = 1;
    for (std::size_t i = std::size_t(node) + 1; i < in.size(); ++i)  // parents precede their children
        if (const int parent = scene.nodes[i].parent; parent >= 0) in[i] = in[std::size_t(parent)];
    return in;
}

/// Returns the world bounds of the marked nodes' meshes, each by the box in the node's own axes.
Bounds bounds_of_marked(const Scene& scene, const std::vector<char>& marked) {
    Bounds all;
    for (const Object* o : all_objects(scene)) {
        if (!marked[std::size_t(o->node)]) continue;
        const Bounds& local = scene.meshes[std::size_t(o->mesh)].bounds;
        if (!local.empty() && std::isfinite(local.radius())) all.add(local.transformed(o->world));
    }
    return all;
}

void set_switch(Settings& s, const std::string& path, const char* key, bool on) {
    if (const auto ref = find_setting("object." + path + "." + key)) set_value(s, *ref, on);
}

/// Switches a setting on for all objects.
void switch_all_on(Settings& settings, bool ObjectSettings::*member, const char* key) {
    const auto objects = settings.objects;  // a copy, because setting a value changes the list
    for (const auto& [path, own] : objects)
        if (!(own.*member)) set_switch(settings, path, key, true);
}

}  // namespace

std::string last_path_part(const std::string& path) {
    const auto slash = path.find_last_of('/');
    return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::optional<Box> box_of(const Scene& scene, const std::string& path) {
    const int node = node_of(scene, path);
    if (node < 0) return {};
    const Bounds local = local_bounds(scene, node);
    if (local.empty() || !std::isfinite(local.radius())) return {};
    return local.corners(scene.nodes[std::size_t(node)].world);
}

Bounds bounds_of(const Scene& scene, const std::string& path) {
    Bounds bounds;
    if (const auto corners = box_of(scene, path))
        for (const glm::dvec3& p : *corners) bounds.add(p);
    return bounds;
}

Bounds bounds_of(const Scene& scene, const std::set<std::string>& paths) {
    if (paths.size() == 1) return bounds_of(scene, *paths.begin());
    std::vector<char> marked(scene.nodes.size(), 0);
    for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = paths.count(scene.nodes[i].path) > 0;
    return bounds_of_marked(scene, marked);
}

Bounds bounds_below(const Scene& scene, const std::string& path) {
    return bounds_of_marked(scene, below(scene, node_of(scene, path)));
}

std::vector<std::string> mesh_nodes_below(const Scene& scene, int node) {
    const std::vector<char> in = below(scene, node);
    std::vector<char> placed(in.size(), 0);
    for (const Object* o : all_objects(scene)) placed[std::size_t(o->node)] = in[std::size_t(o->node)];
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < placed.size(); ++i)
        if (placed[i]) paths.push_back(scene.nodes[i].path);
    return paths;
}

std::set<std::string> selected_objects(const EditorState& state) {
    std::set<std::string> all = state.selection.others;
    if (!state.selection.first.empty()) all.insert(state.selection.first);
    return all;
}

bool is_selected(const EditorState& state, const std::string& path) {
    return !path.empty() && (state.selection.first == path || state.selection.others.count(path) > 0);
}

void select_objects(EditorState& state, std::span<const std::string> paths) {
    state.selection.first = paths.empty() ? std::string() : paths[0];
    state.selection.others.clear();
    if (!paths.empty()) state.selection.others.insert(paths.begin() + 1, paths.end());
    state.objects.sought = state.selection.first;
    state.objects.scroll_frames = 0;
}

void toggle_object(EditorState& state, const std::string& path) {
    if (state.selection.others.erase(path) > 0) return;
    if (state.selection.first == path) {
        state.selection.first = state.selection.others.empty() ? std::string() : *state.selection.others.begin();
        state.selection.others.erase(state.selection.first);
    } else if (state.selection.first.empty()) {
        state.selection.first = path;
    } else {
        state.selection.others.insert(path);
    }
}

void cast_alone(Settings& settings, const Scene& scene, const std::set<std::string>& paths) {
    for (const Object* o : all_objects(scene)) {
        const std::string& path = scene.nodes[std::size_t(o->node)].path;
        if (!o->ground) set_switch(settings, path, "cast", paths.count(path) > 0);  // the ground never casts
    }
}

void cast_all(Settings& settings) {
    switch_all_on(settings, &ObjectSettings::cast, "cast");
}

void hide(Settings& settings, const std::set<std::string>& paths) {
    for (const std::string& path : paths) set_switch(settings, path, "shown", false);
}

void isolate(Settings& settings, const Scene& scene, const std::set<std::string>& paths) {
    for (const Object* o : all_objects(scene)) {
        const std::string& path = scene.nodes[std::size_t(o->node)].path;
        if (!o->ground || paths.count(path) > 0) set_switch(settings, path, "shown", paths.count(path) > 0);
    }
}

void show_all(Settings& settings) {
    switch_all_on(settings, &ObjectSettings::shown, "shown");
}

bool all_shown(const Settings& settings) {
    return std::ranges::all_of(settings.objects, [](const auto& own) { return own.second.shown; });
}

}  // namespace si
