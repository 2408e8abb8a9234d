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

/// Returns the last part of a node's or a file's path, after the last slash.
std::string last_path_part(const std::string& path);

/// Returns the world bounds of the meshes at these nodes; empty: there are none.
Bounds bounds_of(const Scene& scene, const std::set<std::string>& paths);
/// Returns the world bounds of the meshes at this node; empty: there are none.
Bounds bounds_of(const Scene& scene, const std::string& path);
/// Returns the world bounds of the meshes at this node and all nodes below it.
Bounds bounds_below(const Scene& scene, const std::string& path);

/// Returns the eight world corners of a node's mesh box, aligned to the node's own axes. Bits 0, 1, 2 of a corner's
/// index choose x, y, z. Nothing for a node without a mesh.
std::optional<Box> box_of(const Scene& scene, const std::string& path);

/// Returns the paths of the nodes with a mesh among `node` (an index) and all nodes below it.
std::vector<std::string> mesh_nodes_below(const Scene& scene, int node);

/// Returns the paths of all selected objects.
std::set<std::string> selected_objects(const EditorState& state);
/// Returns true if the object is selected.
bool is_selected(const EditorState& state, const std::string& path);
/// Makes these objects the whole selection; others are no longer selected.
void select_objects(EditorState& state, std::span<const std::string> paths);
/// Adds an object to the selection, or removes it if it is selected.
void toggle_object(EditorState& state, const std::string& path);

/// Makes these objects the only casters (object.PATH.cast).
void cast_alone(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Makes all objects casters again: resets object.PATH.cast.
void cast_all(Settings& settings);
/// Hides these objects (object.PATH.shown).
void hide(Settings& settings, const std::set<std::string>& paths);
/// Hides all objects except these and the ground under the scene.
void isolate(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Shows all objects.
void show_all(Settings& settings);
/// Returns true if no object is hidden.
bool all_shown(const Settings& settings);

}  // namespace si
