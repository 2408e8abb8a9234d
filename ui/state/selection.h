// Objects of the scene by node path: which are chosen, their boxes, and what is done to several at once.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/state/editor_ui.h"

namespace si {

/// What a node's or a file's path ends in.
std::string last_part(const std::string& path);

/// World bounds of all that the nodes with these paths place; empty when there are none.
Bounds bounds_of(const Scene& scene, const std::set<std::string>& paths);
/// Of one.
Bounds bounds_of(const Scene& scene, const std::string& path);
/// Of the node with this path and all below it.
Bounds bounds_below(const Scene& scene, const std::string& path);

/// Eight world corners of the box around what the node places, in the node's own axes; bit 0 of the index is x, bit 1
/// y, bit 2 z. Nothing when it places nothing.
std::optional<Box> box_of(const Scene& scene, const std::string& path);

/// The paths of the node and of all below it that place a mesh.
std::vector<std::string> placed_below(const Scene& scene, int node);

/// All that are chosen.
std::set<std::string> selected_objects(const EditorState& state);
bool is_selected(const EditorState& state, const std::string& path);
/// These alone; none when there are none.
void select_objects(EditorState& state, std::span<const std::string> paths);
/// One more, or one less.
void toggle_object(EditorState& state, const std::string& path);

/// Lets these cast, and nothing else of the scene.
void cast_alone(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Lets everything cast.
void cast_all(Settings& settings);
/// These are no longer there (object.PATH.shown).
void hide(Settings& settings, const std::set<std::string>& paths);
/// Nothing else is there, but the ground put under the scene.
void isolate(Settings& settings, const Scene& scene, const std::set<std::string>& paths);
/// Everything is there.
void show_all(Settings& settings);
bool all_shown(const Settings& settings);

}  // namespace si
