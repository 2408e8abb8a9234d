// Panel Objects: the tree of objects with their own settings (culling, casting, receiving), and marks of casters that
// culling removes from the map.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "renderer/base/words_match.h"
#include "ui/state/panels.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Row of the tree: a node with a mesh, or an ancestor of one.
struct Row {
    int node = 0, depth = 0;
    const std::string* path = nullptr;
    bool placed = false;               ///< the node has a mesh, and so has settings
    bool above = false;                ///< the node has rows below it
    std::size_t triangles = 0;         ///< triangles of the node and all nodes below it
    const LostCaster* lost = nullptr;  ///< an object that leaves no texel in the shown light's map
};

/// Order of the list.
struct Order {
    int column = -1;  ///< column to sort by; below 0: the order of the file
    bool down = false;
    bool fresh = false;  ///< chosen in this frame
};

/// Part of the tree that matches the search.
struct Tree {
    std::vector<Row> rows;                   ///< one a node of the scene
    std::vector<std::vector<int>> children;  ///< listed children by node
    std::vector<int> roots;
    std::size_t placed = 0;  ///< rows with settings
};

Tree tree_of(const EditorState& state, const EditorFrame& frame) {
    const Scene& scene = *frame.scene;
    const std::size_t count = scene.nodes.size();
    Tree tree{.rows = std::vector<Row>(count), .children = std::vector<std::vector<int>>(count)};
    std::vector<char> in(count, 0);
    for (const Object* o : all_objects(scene)) {
        Row& row = tree.rows[std::size_t(o->node)];
        row.placed = true;
        row.triangles += scene.meshes[std::size_t(o->mesh)].indices.size() / 3;
    }
    for (const LostCaster& l : frame.lost_casters)
        if (std::size_t(l.object) < scene.objects.size())
            tree.rows[std::size_t(scene.objects[std::size_t(l.object)].node)].lost = &l;
    for (std::size_t i = count; i-- > 0;) {  // parents precede their children
        Row& row = tree.rows[i];
        row.node = int(i);
        row.path = &scene.nodes[i].path;
        row.placed &= (!state.objects.only_lost || row.lost) && matches_all_words(state.objects.search, {*row.path});
        if (!row.placed && !row.above) continue;
        in[i] = 1;
        tree.placed += row.placed;
        if (const int parent = scene.nodes[i].parent; parent >= 0) {
            Row& up = tree.rows[std::size_t(parent)];
            up.above = true;
            up.triangles += row.triangles;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!in[i]) continue;
        const int parent = scene.nodes[i].parent;
        (parent < 0 ? tree.roots : tree.children[std::size_t(parent)]).push_back(int(i));
    }
    return tree;
}

/// Returns the sort keys of a settings' column. A node with children has the largest key of them.
std::vector<double> ranks(const Tree& tree, const Scene& scene, const Settings& settings, const Param& p) {
    std::vector<double> out(tree.rows.size(), -1);
    for (std::size_t i = out.size(); i-- > 0;) {
        if (tree.rows[i].placed) {
            const Value v = get_value(settings, {&p, 0, *tree.rows[i].path});
            out[i] = std::max(out[i], numeric_value(v));
        }
        if (const int parent = scene.nodes[i].parent; parent >= 0)
            out[std::size_t(parent)] = std::max(out[std::size_t(parent)], out[i]);
    }
    return out;
}

/// Sorts the rows by their settings at the time of the click, so that a changed row keeps its place.
void sort_rows(Tree& tree, const Scene& scene, EditorState& state, std::span<const Param* const> params, Order order) {
    if (order.column < 0) return;
    std::vector<double> rank;
    std::vector<std::string> name;
    if (order.column == 0)
        for (const Row& row : tree.rows) name.push_back(last_path_part(*row.path));
    else if (order.column == 1)
        for (const Row& row : tree.rows) rank.push_back(double(row.triangles));
    else if (order.fresh || state.objects.ranks_scene != scene.id || state.objects.ranks.size() != tree.rows.size()) {
        state.objects.ranks = ranks(tree, scene, state.settings, *params[std::size_t(order.column - 2)]);
        state.objects.ranks_scene = scene.id;
    }
    const std::vector<double>& by = order.column == 1 ? rank : state.objects.ranks;
    const auto before = [&](int a, int b) {
        if (order.down) std::swap(a, b);
        return name.empty() ? by[std::size_t(a)] < by[std::size_t(b)] : name[std::size_t(a)] < name[std::size_t(b)];
    };
    std::ranges::stable_sort(tree.roots, before);
    for (auto& list : tree.children) std::ranges::stable_sort(list, before);
}

/// Returns the visible rows, from top to bottom. A search shows matches below closed nodes, too.
std::vector<const Row*> open_rows(Tree& tree, const EditorState& state) {
    const bool all = !state.objects.search.empty() || state.objects.only_lost;
    std::vector<const Row*> list;
    std::vector<std::pair<int, int>> todo;  // node, depth
    const auto push = [&](const std::vector<int>& nodes, int depth) {
        for (std::size_t i = nodes.size(); i-- > 0;) todo.emplace_back(nodes[i], depth);
    };
    push(tree.roots, 0);
    while (!todo.empty()) {
        const auto [node, depth] = todo.back();
        todo.pop_back();
        Row& row = tree.rows[std::size_t(node)];
        row.depth = depth;
        list.push_back(&row);
        if (all || !state.objects.closed_nodes.count(*row.path)) push(tree.children[std::size_t(node)], depth + 1);
    }
    return list;
}

/// Returns a copy of the settings without those of objects.
Settings without_objects(Settings& s) {
    std::map<std::string, ObjectSettings> aside;
    aside.swap(s.objects);
    Settings out = s;
    s.objects.swap(aside);
    return out;
}

void lost_line(EditorState& state, const EditorFrame& frame, const Tree& tree) {
    if (frame.lost_casters.empty()) {
        state.objects.only_lost = false;
        return;
    }
    ImGui::AlignTextToFramePadding();
    const auto count_of = [&](LostBy by) { return std::ranges::count(frame.lost_casters, by, &LostCaster::by); };
    std::string text;
    for (const auto& [by, words] : {std::pair(LostBy::Culling, "lost to culling"),
                                    {LostBy::NearPlane, "before the near plane"},
                                    {LostBy::Blending, "blended"}})
        if (const auto count = count_of(by); count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, words);
    coloured_text(text, theme::warning());
    plain_tooltip(
        fmt::format("Objects that are to cast a shadow but leave nothing in light {}'s map: every one of their\n"
                    "triangles faces the way that is culled, as of floors and open meshes, which have no back;\n"
                    "or they lie before the near plane; or their material blends, which casts nothing by default.",
                    shown_light(state.settings)));
    same_line_if_fits(button_width("Show only lost") + ImGui::GetFrameHeight());
    ImGui::Checkbox("Show only lost", &state.objects.only_lost);
    if (count_of(LostBy::Culling) > 0) {
        same_line_if_fits(button_width("Cast from both sides"));
        if (ImGui::Button("Cast from both sides"))
            for (const Row& row : tree.rows)
                if (row.placed && row.lost && row.lost->by == LostBy::Culling)
                    state.settings.objects[*row.path].cull = ObjectCull::None;
        plain_tooltip("Set object.<path>.cull to none for each, so that all faces cast");
    }
    if (count_of(LostBy::Blending) > 0) {
        same_line_if_fits(button_width("Blended ones cast"));
        if (ImGui::Button("Blended ones cast")) state.settings.caster.blend = BlendCasters::Mask;
        plain_tooltip("Set caster.blend to mask: blended surfaces cast where their alpha is at least 0.5");
    }
}

/// Draws the arrow that opens or closes the rows below a node.
void arrow(EditorState& state, const Row& row, float width) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float size = ImGui::GetFrameHeight();
    if (!row.above) return ImGui::Dummy({width, size});
    if (ImGui::InvisibleButton(("open " + *row.path).c_str(), {width, size}))
        if (!state.objects.closed_nodes.erase(*row.path)) state.objects.closed_nodes.insert(*row.path);
    const bool open =
        !state.objects.closed_nodes.count(*row.path) || !state.objects.search.empty() || state.objects.only_lost;
    ImGui::RenderArrow(ImGui::GetWindowDrawList(), {at.x, at.y + ImGui::GetStyle().FramePadding.y},
                       ImGui::IsItemHovered() ? theme::text() : theme::muted(), open ? ImGuiDir_Down : ImGuiDir_Right,
                       0.8f);
}

/// Selects the row's object, or for a node without a mesh all objects below it: alone, with Ctrl in addition (or
/// removed), with Shift all rows from the first selected one.
void select_row(EditorState& state, const Scene& scene, const std::vector<const Row*>& list, std::size_t at) {
    const ImGuiIO& io = ImGui::GetIO();
    const Row& row = *list[at];
    const auto first = std::ranges::find_if(list, [&](const Row* r) { return *r->path == state.selection.first; });
    if (io.KeyShift && first != list.end()) {
        const std::size_t from = std::size_t(first - list.begin());
        std::vector<std::string> range{state.selection.first};
        for (std::size_t i = std::min(from, at); i <= std::max(from, at); ++i)
            if (list[i]->placed && i != from) range.push_back(*list[i]->path);
        return select_objects(state, range);
    }
    const std::vector<std::string> paths =
        row.placed ? std::vector<std::string>{*row.path} : mesh_nodes_below(scene, row.node);
    const std::set<std::string> wanted(paths.begin(), paths.end());
    if (!io.KeyCtrl)
        return select_objects(state, selected_objects(state) == wanted ? std::vector<std::string>() : paths);
    const bool all = std::ranges::all_of(paths, [&](const auto& path) { return is_selected(state, path); });
    for (const std::string& path : paths)
        if (is_selected(state, path) == all) toggle_object(state, path);
}

void end_seeking(EditorState& state) {
    state.objects.sought.clear();
    state.objects.scroll_frames = 0;
}

/// Draws the object's name, which selects the object by a click.
void name_cell(EditorState& state, const Scene& scene, const std::vector<const Row*>& list, std::size_t at) {
    const Row& row = *list[at];
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em * 0.9f * float(std::min(row.depth, 12)));
    arrow(state, row, em);
    ImGui::SameLine();
    const bool own = row.placed && state.settings.objects.contains(*row.path);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, row.lost     ? theme::warning()
                                         : own        ? theme::accent()
                                         : row.placed ? theme::text()
                                                      : theme::muted());
    const std::string name = last_path_part(*row.path);
    const char* const lost = !row.lost                           ? ""
                             : row.lost->by == LostBy::Blending  ? "   blended, casts nothing"
                             : row.lost->by == LostBy::NearPlane ? "   before the near plane"
                                                                 : "   lost by culling";
    const std::string label = name + lost;
    if (ImGui::Selectable((label + "###" + *row.path).c_str(), is_selected(state, *row.path))) {
        select_row(state, scene, list, at);
        end_seeking(state);  // the row is under the mouse already
    }
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    if (!ImGui::IsItemHovered()) return;
    state.objects.hovered = *row.path;
    if (row.lost)
        ImGui::SetTooltip("%s", lost_caster_text(scene, *row.lost, shown_light(state.settings)).c_str());
    else
        ImGui::SetTooltip("%s\nClick to select, Ctrl one more, Shift all between; %s frames them", row.path->c_str(),
                          key_text(Command::FrameSelection));
}

/// Draws the settings of an object. A change of a selected one changes all selected objects.
void setting_cells(EditorState& state, Settings& alone, const Row& row, std::span<const Param* const> params) {
    for (const Param* p : params) {
        if (!ImGui::TableNextColumn() || !row.placed) continue;
        const SettingRef ref{p, 0, *row.path};
        set_value(alone, ref, get_value(state.settings, ref));
        if (setting_widget(alone, ref)) {
            const Value value = get_value(alone, ref);
            set_value(state.settings, ref, value);
            if (is_selected(state, *row.path))
                for (const std::string& path : selected_objects(state)) set_value(state.settings, {p, 0, path}, value);
        }
        alone.objects.clear();
    }
}

/// Frames in which the list scrolls to a row, because its place is an estimate at first.
constexpr int kSeekFrames = 4;

/// Opens the nodes above an object that was selected elsewhere.
void begin_seeking(EditorState& state) {
    const std::string& path = state.objects.sought;
    if (path.empty() || state.objects.scroll_frames > 0) return;
    state.objects.scroll_frames = kSeekFrames;
    for (std::size_t at = path.find('/'); at != path.npos; at = path.find('/', at + 1))
        state.objects.closed_nodes.erase(path.substr(0, at));
}

/// Scrolls the list until the row drawn last is fully visible.
void bring_into_view(EditorState& state) {
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool seen =
        ImGui::GetItemRectMin().y >= list.GetClipRectMin().y && ImGui::GetItemRectMax().y <= list.GetClipRectMax().y;
    if (!seen) ImGui::SetScrollHereY();
    if (seen || --state.objects.scroll_frames == 0) end_seeking(state);
}

/// Column of settings right of the names.
struct SettingColumn {
    std::string label;
    float width = 0;     ///< pixels
    int drop_order = 0;  ///< order in which columns are dropped without room: 1 first; 0 never
    bool shown = true;
};

/// Returns the columns that fit while names stay readable.
std::vector<SettingColumn> fitting_columns(std::span<const Param* const> params) {
    constexpr float kMinName = 8;  // ems
    const float em = ImGui::GetFontSize(), padding = 2 * ImGui::GetStyle().CellPadding.x;
    std::vector<SettingColumn> all{{"Triangles", em * 5, 1}};
    for (const Param* p : params)
        all.push_back({std::string(p->label), p->choices ? em * 9 : em * 5,
                       p->key == "object.receive" ? 2
                       : p->key == "object.cull"  ? 3
                                                  : 0});
    float name = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize - padding;
    for (const SettingColumn& c : all) name -= c.width + padding;
    for (int next = 1; next <= 3 && name < em * kMinName; ++next)
        for (SettingColumn& c : all)
            if (c.drop_order == next) {
                c.shown = false;
                name += c.width + padding;
            }
    // In the narrowest inspector, the columns of boxes are as wide as their titles.
    for (SettingColumn& c : all) {
        if (!c.shown || name >= em * kMinName) continue;
        const float narrow = std::min(c.width, em * 3.6f);
        name += c.width - narrow;
        c.width = narrow;
    }
    return all;
}

/// Returns the order that a click on a header has chosen.
Order order_of() {
    ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (!specs || specs->SpecsCount == 0) return {};
    const bool fresh = std::exchange(specs->SpecsDirty, false);
    return {specs->Specs[0].ColumnIndex, specs->Specs[0].SortDirection == ImGuiSortDirection_Descending, fresh};
}

}  // namespace

void draw_objects(EditorState& state, const EditorFrame& frame) {
    state.objects.hovered.clear();
    if (!frame.scene) return ImGui::TextDisabled("No scene.");
    std::vector<const Param*> rows;
    for (const Param& p : params())
        if (p.scope == Scope::Object) rows.push_back(&p);
    const float em = ImGui::GetFontSize();
    Tree tree = tree_of(state, frame);
    const std::string placed = fmt::format("{} object{}", tree.placed, tree.placed == 1 ? "" : "s");
    const std::string counts = fmt::format("{}, {} with settings of their own", placed, state.settings.objects.size());
    const bool all = all_shown(state.settings);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const bool fits = ImGui::CalcTextSize(counts.c_str()).x + gap + em * 8 <= ImGui::GetContentRegionAvail().x;
    const std::string& count = fits ? counts : placed;
    const float count_width = ImGui::CalcTextSize(count.c_str()).x + gap + (all ? 0 : button_width("Show all") + gap);
    search_field("objects", "Search objects", state.objects.search,
                 std::max(count_width, ImGui::GetContentRegionAvail().x - em * 24));
    ImGui::SameLine();
    ImGui::TextDisabled("%s", count.c_str());
    if (!fits) plain_tooltip(counts);
    if (!all) {
        same_line_if_fits(button_width("Show all"));
        if (ImGui::Button("Show all")) show_all(state.settings);
        wrapped_tooltip(with_key("Brings back what is hidden", Command::ShowAllObjects));
    }
    lost_line(state, frame, tree);
    if (tree.placed == 0)
        return ImGui::TextDisabled(state.objects.search.empty()
                                       ? "No object casts or receives."
                                       : "No object's path holds these words. × clears the search.");
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable |
                                      ImGuiTableFlags_SortTristate | ImGuiTableFlags_SizingStretchProp |
                                      ImGuiTableFlags_NoSavedSettings;
    const std::vector<SettingColumn> columns = fitting_columns(rows);
    if (!ImGui::BeginTable("objects", int(rows.size()) + 2, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Object", ImGuiTableColumnFlags_WidthStretch, 3);
    for (const SettingColumn& c : columns) {
        ImGuiTableColumnFlags of = ImGuiTableColumnFlags_WidthFixed;
        if (&c == &columns.front()) of |= ImGuiTableColumnFlags_PreferSortDescending;
        if (!c.shown) of |= ImGuiTableColumnFlags_Disabled;
        ImGui::TableSetupColumn(c.label.c_str(), of, c.width);
    }
    ImGui::TableHeadersRow();
    sort_rows(tree, *frame.scene, state, rows, order_of());
    begin_seeking(state);
    const std::vector<const Row*> list = open_rows(tree, state);
    const auto sought =
        std::ranges::find(list, state.objects.sought, [](const Row* r) -> const std::string& { return *r->path; });
    const int seek = sought == list.end() ? -1 : int(sought - list.begin());
    if (seek < 0) end_seeking(state);
    // The settings with one object's at a time: a widget may leave an override equal to the defaults, which set_value()
    // does not; and copies of ten thousand overrides for each widget would be slow.
    Settings alone = without_objects(state.settings);
    ImGuiListClipper clipper;
    clipper.Begin(int(list.size()));
    if (seek >= 0) clipper.ForceDisplayRangeByIndices(seek, seek + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Row& row = *list[std::size_t(i)];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            name_cell(state, *frame.scene, list, std::size_t(i));
            if (i == seek) bring_into_view(state);
            ImGui::TableNextColumn();
            ImGui::AlignTextToFramePadding();
            ImGui::TextUnformatted(fmt::format("{}", row.triangles).c_str());
            setting_cells(state, alone, row, rows);
        }
    }
    ImGui::EndTable();
}

}  // namespace si
