// Objects of the scene by node path: selection, boxes, and changes of several at once.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns the part after the last slash of a node's or file's path. Returns a path without a slash unchanged.
std::string last_path_part(const std::string& path);

/// Returns the world bounds of the meshes at the nodes with these paths, without child nodes. Empty if they have no
/// mesh.
Bounds bounds_of(const Scene& scene, const std::set<std::string>& paths);
/// Returns the world bounds of the meshes at the node with this path, without child nodes. Empty if it has no mesh.
Bounds bounds_of(const Scene& scene, const std::string& path);
/// Returns the world bounds of the meshes at the node with this path and all nodes below it. Empty without a mesh.
Bounds bounds_below(const Scene& scene, const std::string& path);

/// Returns the eight world corners of the box around a node's mesh, aligned to the node's own axes. Bits 0, 1, 2 of a
/// corner's index choose x, y, z. Nothing for a node without a mesh.
std::optional<Box> box_of(const Scene& scene, const std::string& path);

/// Returns the paths of all nodes with a mesh, among a node and all nodes below it. @param node the index of the node
std::vector<std::string> mesh_nodes_below(const Scene& scene, int node);

/// Returns the node paths of all objects that are selected in the editor.
std::set<std::string> selected_objects(const EditorState& state);
/// Returns true if the object with this node path is selected in the editor.
bool is_selected(const EditorState& state, const std::string& path);
/// Selects these objects in the editor and deselects all others. @param paths node paths; empty: selects nothing
void select_objects(EditorState& state, std::span<const std::string> paths);
/// Adds an object to the editor's selection, or removes it if it is selected. @param path node path of the object
void toggle_object(EditorState& state, const std::string& path);

/// Makes these objects the only shadow casters (setting object.PATH.cast). @param paths node paths of the objects
void cast_alone(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Makes all objects shadow casters again: switches object.PATH.cast on.
void cast_all(Settings& settings);
/// Hides these objects in the scene (setting object.PATH.shown). @param paths node paths of the objects
void hide(Settings& settings, const std::set<std::string>& paths);
/// Shows only these objects and hides all others, except the ground under the scene. @param paths node paths of the
/// objects
void isolate(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Shows all objects again that hide() or isolate() has hidden.
void show_all(Settings& settings);
/// Returns true if no object of the scene is hidden (object.PATH.shown).
bool all_shown(const Settings& settings);

}  // namespace si
