#include "renderer/bundle/bundle_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/json_shape.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/bundle_members.h"
#include "renderer/bundle/bundle_path.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

using Json = nlohmann::json;

/// Position in a frame.json: its file, and the path of members.
struct JsonPlace {
    std::string file;
    std::string path;  ///< "lights[0].maps[1]"; empty: the whole file

    JsonPlace member(std::string_view name) const {
        return {file, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name)};
    }
    JsonPlace element(std::size_t index) const { return {file, fmt::format("{}[{}]", path, index)}; }
    [[noreturn]] void fail(std::string_view what, std::string_view fix) const {
        const std::string place = path.empty() ? std::string() : printable(path, 300) + ": ";
        throw Error(fmt::format("{}: {}{}; {}", printable(file, 300), place, what, fix));
    }
};

/// Returns a JSON value as a short printable text, for messages.
std::string shown_json(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("a list of {}", value.size());
    return printable(value.dump(-1, ' ', false, Json::error_handler_t::replace), 60);
}

std::string quoted_keys(const auto& keys) {
    std::vector<std::string> out;
    for (const auto& key : keys) out.emplace_back(key.first);
    return fmt::format("{}", fmt::join(out, ", "));
}

// Reading of one value of each kind.

std::string read_value(const JsonPlace& place, const bundle::Text& kind, const Json& v) {
    if (!v.is_string()) place.fail(fmt::format("{} is no text", shown_json(v)), "give a text in quotes");
    const auto& text = v.get_ref<const std::string&>();
    if (text.size() > kind.max_bytes)
        place.fail(fmt::format("the text has {} bytes", text.size()), fmt::format("use at most {}", kind.max_bytes));
    return text;
}

std::string read_value(const JsonPlace& place, const bundle::Path&, const Json& v) {
    std::string text = read_value(place, bundle::Text{}, v);
    if (const std::string_view fault = bundle_path_fault(text); !fault.empty())
        place.fail(fmt::format("the file name \"{}\" {}", printable(text, 100), fault),
                   "name a file of the bundle by a relative path with /");
    return text;
}

double read_number(const JsonPlace& place, const Json& v) {
    if (!v.is_number()) place.fail(fmt::format("{} is no number", shown_json(v)), "give a number");
    return v.get<double>();
}

double read_value(const JsonPlace& place, const bundle::Number& kind, const Json& v) {
    const double x = read_number(place, v);
    if (kind.above && !(x > kind.least))
        place.fail(fmt::format("{} is out of range", x), fmt::format("give a number above {}", kind.least));
    if (x < kind.least || x > kind.most)
        place.fail(fmt::format("{} is out of range", x),
                   fmt::format("give a number from {} to {}", kind.least, kind.most));
    return x;
}

int read_value(const JsonPlace& place, const bundle::Integer& kind, const Json& v) {
    const double x = read_number(place, v);
    if (x != std::floor(x) || x < kind.least || x > kind.most)
        place.fail(fmt::format("{} is out of range", x),
                   fmt::format("give a whole number from {} to {}", kind.least, kind.most));
    return int(x);
}

bool read_value(const JsonPlace& place, const bundle::Switch&, const Json& v) {
    if (!v.is_boolean()) place.fail(fmt::format("{} is neither true nor false", shown_json(v)), "give true or false");
    return v.get<bool>();
}

template <std::size_t size>
std::array<double, size> read_numbers(const JsonPlace& place, const Json& v) {
    if (!v.is_array() || v.size() != size)
        place.fail(fmt::format("{} stands where a list of {} numbers is needed", shown_json(v), size),
                   fmt::format("give {} numbers", size));
    std::array<double, size> out;
    for (std::size_t i = 0; i < size; ++i) out[i] = read_number(place.element(i), v[i]);
    return out;
}

glm::dmat4 read_value(const JsonPlace& place, const bundle::Matrix&, const Json& v) {
    const auto n = read_numbers<16>(place, v);
    glm::dmat4 out;
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = n[std::size_t(i)];
    return out;
}

glm::dvec3 read_value(const JsonPlace& place, const bundle::Vector&, const Json& v) {
    const auto n = read_numbers<3>(place, v);
    return {n[0], n[1], n[2]};
}

std::array<double, 2> read_value(const JsonPlace& place, const bundle::Pair& kind, const Json& v) {
    const auto n = read_numbers<2>(place, v);
    for (const double x : n)
        if (x < kind.least || x > kind.most)
            place.fail(fmt::format("{} is out of range", x),
                       fmt::format("give numbers from {} to {}", kind.least, kind.most));
    if (!(n[0] < n[1]) && !(kind.may_equal && n[0] == n[1]))
        place.fail(fmt::format("{} does not lie below {}", n[0], n[1]), "give the smaller number first");
    return n;
}

DepthWarp read_value(const JsonPlace& place, const bundle::Warp&, const Json& v) {
    const auto n = read_numbers<4>(place, v);
    if (!(n[3] > -1)) place.element(3).fail(fmt::format("the rise {} is not above -1", n[3]), "give a number above -1");
    return {n[0], n[1], n[2], n[3]};
}

BundleRegion read_value(const JsonPlace& place, const bundle::Region&, const Json& v) {
    if (!v.is_array() || v.size() != 4)
        place.fail(fmt::format("{} stands where x, y, width and height are needed", shown_json(v)),
                   "give four whole numbers");
    const bundle::Integer corner{0, kMaxBundleImageSide}, side{1, kMaxBundleImageSide};
    return {read_value(place.element(0), corner, v[0]), read_value(place.element(1), corner, v[1]),
            read_value(place.element(2), side, v[2]), read_value(place.element(3), side, v[3])};
}

std::vector<std::string> read_value(const JsonPlace& place, const bundle::Texts& kind, const Json& v) {
    if (!v.is_array()) place.fail(fmt::format("{} is no list", shown_json(v)), "give a list of texts");
    if (v.size() > kind.most)
        place.fail(fmt::format("the list has {} texts", v.size()), fmt::format("give at most {}", kind.most));
    std::vector<std::string> out;
    for (std::size_t i = 0; i < v.size(); ++i) out.push_back(read_value(place.element(i), bundle::Text{}, v[i]));
    return out;
}

std::map<std::string, std::string> read_value(const JsonPlace& place, const bundle::Dictionary&, const Json& v) {
    if (!v.is_object()) place.fail(fmt::format("{} is no object", shown_json(v)), "give an object of keys and values");
    std::map<std::string, std::string> out;
    for (const auto& [key, value] : v.items()) {
        const JsonPlace at = place.member(key);
        if (value.is_structured() || value.is_null())
            at.fail(fmt::format("{} is no value of a setting", shown_json(value)),
                    "give a text, a number, true or false");
        out[key] = value.is_string() ? read_value(at, bundle::Text{}, value) : value.dump();
    }
    return out;
}

template <typename T>
T read_value(const JsonPlace& place, const bundle::ChoiceOf<T>& kind, const Json& v) {
    std::vector<std::string> names;
    for (const auto& [key, value] : kind.keys) {
        if (v.is_string() && v.get_ref<const std::string&>() == key) return value;
        names.emplace_back(key);
    }
    const std::string nearest = v.is_string() ? nearest_name(v.get_ref<const std::string&>(), names) : std::string();
    place.fail(fmt::format("{} is none of {}", shown_json(v), quoted_keys(kind.keys)),
               nearest.empty() ? "give one of these" : fmt::format("did you mean {}?", nearest));
}

std::array<BiasUnit, 3> read_value(const JsonPlace& place, const bundle::BiasUnits&, const Json& v) {
    const std::string text = read_value(place, bundle::Text{}, v);
    std::array<BiasUnit, 3> out;
    std::string_view rest = text;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t comma = rest.find(',');
        if ((comma == rest.npos) != (i + 1 == out.size()))
            place.fail(fmt::format("\"{}\" has not three units", printable(text, 60)),
                       "name the units of constant, slope and normal: \"depth, depth, metres\"");
        std::string_view unit = rest.substr(0, comma);
        while (unit.starts_with(' ')) unit.remove_prefix(1);
        while (unit.ends_with(' ')) unit.remove_suffix(1);
        out[i] = read_value(place, bundle::ChoiceOf{bundle::kUnitKeys}, Json(unit));
        rest.remove_prefix(comma == rest.npos ? rest.size() : comma + 1);
    }
    return out;
}

// Checks across members of one object.

template <typename T>
void check_object(const JsonPlace&, const T&) {}

void check_matrix(const JsonPlace& place, const BundleMatrix& m) {
    constexpr std::string_view kFix = "give clip_from_world, or projection with view or world_from_view";
    const int given = int(m.clip_from_world.has_value()) + int(m.view.has_value()) + int(m.world_from_view.has_value());
    if (given == 0) place.fail("the matrix is missing", kFix);
    if (given > 1) place.fail("the matrix is given twice", kFix);
    if (m.projection.has_value() == m.clip_from_world.has_value())
        place.fail(m.projection ? "the projection is given beside clip_from_world" : "the projection is missing", kFix);
}

void check_object(const JsonPlace& place, const BundleCamera& c) {
    check_matrix(place, c.clip);
}

void check_object(const JsonPlace& place, const BundleImage& i) {
    const std::string extension = lower_extension(i.file);
    constexpr std::array<std::string_view, 4> kKnown = {".pfm", ".exr", ".png", ".raw"};
    if (std::ranges::find(kKnown, extension) == kKnown.end())
        place.member("file").fail(fmt::format("\"{}\" is no image of a map", printable(i.file, 100)),
                                  "use a .pfm, .exr, .png or .raw file");
    if (extension == ".raw") {
        if (!i.width || !i.height) place.fail("the size of the raw image is missing", "give width and height");
        if (!i.format) place.fail("the format of the raw image is missing", "give format: f32, f16, u16, u24 or u32");
        if (i.channel >= i.channels)
            place.member("channel").fail(fmt::format("channel {} is read of an image of {}", i.channel, i.channels),
                                         "count from 0, and give channels");
    }
}

void check_object(const JsonPlace& place, const BundleDepth& d) {
    if (d.stored == BundleStored::DistanceShare && !d.range_m)
        place.member("range_m").fail("the range of distance-share is missing", "give the distance that is stored as 1");
    if (d.stored == BundleStored::Exponential && !d.exponent)
        place.member("exponent").fail("the exponent of exponential is missing", "give the factor of depth before exp");
}

void check_object(const JsonPlace& place, const BundleMap& m) {
    check_matrix(place, m.clip);
    if (m.edge && !(m.edge->at(1) > 0)) place.member("edge").fail("the map ends in its middle", "give an end above 0");
}

void check_object(const JsonPlace& place, const BundleLight& l) {
    if (l.direction && !(glm::length(*l.direction) > 1e-150 && glm::length(*l.direction) < 1e150))
        place.member("direction").fail("it is no direction", "give a vector of some length");
    if (l.maps.empty()) {
        const bool is_placed = l.type == LightType::Directional ? l.direction.has_value()
                               : l.type == LightType::Point     ? l.position.has_value()
                                                                : l.direction && l.position;
        if (!is_placed)
            place.fail("the light has no map from which its place follows",
                       "give direction and position, as its type needs them");
        return;
    }
    const ViewChoice choice = choice_of(l);
    const JsonPlace at = place.member("choice");
    if (choice == ViewChoice::One && l.maps.size() != 1)
        at.fail(fmt::format("the choice one has {} maps", l.maps.size()), "give one map, or choose by map or interval");
    if (choice == ViewChoice::Face && (l.maps.size() != 6 || l.type == LightType::Directional))
        at.fail(
            fmt::format("the choice face needs a spot or point light with six maps, and there are {}", l.maps.size()),
            "give the faces +x, -x, +y, -y, +z, -z");
    if (choice == ViewChoice::Interval)
        for (std::size_t i = 0; i < l.maps.size(); ++i)
            if (!l.maps[i].interval)
                place.member("maps")
                    .element(i)
                    .member("interval")
                    .fail("the interval of the map is missing", "give the camera depths from and to");
}

void check_object(const JsonPlace& place, const Bundle& b) {
    if (std::ranges::all_of(b.lights, [](const BundleLight& l) { return l.maps.empty(); }))
        place.member("lights").fail("no light has a map", "give a light at least one map");
    const auto needs_camera = [](const BundleLight& l) { return choice_of(l) == ViewChoice::Interval; };
    if (!b.camera && std::ranges::any_of(b.lights, needs_camera))
        place.member("camera").fail("maps are chosen by camera depth, and the camera is missing", "give the camera");
    if (b.scene.empty()) return;
    const std::string extension = lower_extension(b.scene);
    if (extension != ".glb" && extension != ".gltf")
        place.member("scene").fail(fmt::format("\"{}\" is no glTF file", printable(b.scene, 100)),
                                   "give a .glb or .gltf file");
}

/// FrameReader of one object of frame.json.
class FrameReader {
public:
    FrameReader(const Json& object, JsonPlace place) : object_(object), place_(std::move(place)) {
        if (!object.is_object()) place_.fail(fmt::format("{} is no object", shown_json(object)), "give an object");
    }

    void version(const char* name, int known) {
        const Json* v = find(name);
        if (!v) place_.fail(fmt::format("the member {} is missing", name), fmt::format("give \"{}\": {}", name, known));
        const int version = read_value(place_.member(name), bundle::Integer{1}, *v);
        if (version != known)
            place_.member(name).fail(fmt::format("version {} of the format is unknown", version),
                                     fmt::format("write version {}", known));
    }
    template <typename Kind>
    void required(const char* name, const Kind& kind, typename Kind::Type& member) {
        const Json* v = find(name);
        if (!v) place_.fail(fmt::format("the member {} is missing", name), "add it");
        member = read_value(place_.member(name), kind, *v);
    }
    template <typename Kind>
    void value(const char* name, const Kind& kind, typename Kind::Type& member, const typename Kind::Type& fallback) {
        const Json* v = find(name);
        member = v ? read_value(place_.member(name), kind, *v) : fallback;
    }
    template <typename Kind>
    void optional(const char* name, const Kind& kind, std::optional<typename Kind::Type>& member) {
        if (const Json* v = find(name)) member = read_value(place_.member(name), kind, *v);
    }
    template <typename T>
    void object(const char* name, T& member) {
        if (const Json* v = find(name)) read_object(*v, place_.member(name), member);
    }
    template <typename T>
    void required_object(const char* name, T& member) {
        const Json* v = find(name);
        if (!v) place_.fail(fmt::format("the member {} is missing", name), "add it");
        read_object(*v, place_.member(name), member);
    }
    template <typename T>
    void optional_object(const char* name, std::optional<T>& member) {
        if (const Json* v = find(name)) read_object(*v, place_.member(name), member.emplace());
    }
    template <typename T>
    void list(const char* name, std::vector<T>& out, std::size_t least, std::size_t most) {
        const Json* v = find(name);
        if (!v) place_.fail(fmt::format("the member {} is missing", name), "add it");
        const JsonPlace at = place_.member(name);
        if (!v->is_array()) at.fail(fmt::format("{} is no list", shown_json(*v)), "give a list");
        if (v->size() < least || v->size() > most)
            at.fail(fmt::format("the list has {} members", v->size()), fmt::format("give {} to {}", least, most));
        out.resize(v->size());
        for (std::size_t i = 0; i < out.size(); ++i) read_object((*v)[i], at.element(i), out[i]);
    }

    /// Reads an object whole, and checks it.
    template <typename T>
    static void read_object(const Json& object, const JsonPlace& place, T& out) {
        FrameReader reader(object, place);
        bundle::members(reader, out);
        reader.refuse_unknown();
        check_object(place, out);
    }

private:
    const Json* find(const char* name) {
        known_.emplace_back(name);
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }
    void refuse_unknown() {
        known_.emplace_back("extras");
        for (const auto& [key, value] : object_.items())
            if (std::ranges::find(known_, key) == known_.end()) {
                const std::string nearest = nearest_name(key, known_);
                place_.fail(fmt::format("the member \"{}\" is unknown", printable(key, 60)),
                            nearest.empty() ? "put it into extras" : fmt::format("did you mean {}?", nearest));
            }
    }

    const Json& object_;
    JsonPlace place_;
    std::vector<std::string> known_;
};

/// Parses JSON in which no object has a name twice.
Json parse_unique(const JsonPlace& place, std::string_view text) {
    constexpr int kDeepest = 64;
    constexpr std::size_t kMostValues = 1'000'000;
    const JsonShape shape = json_shape(text);
    if (shape.depth > kDeepest)
        place.fail(fmt::format("the JSON nests {} levels deep", shape.depth), fmt::format("use at most {}", kDeepest));
    if (shape.values > kMostValues)
        place.fail(fmt::format("the JSON has {} values", shape.values), fmt::format("use at most {}", kMostValues));
    std::vector<std::set<std::string>> names;  // by depth
    const auto watch = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) names.emplace_back();
        if (event == Json::parse_event_t::object_end) names.pop_back();
        if (event == Json::parse_event_t::key && !names.back().insert(value.get<std::string>()).second)
            place.fail(fmt::format("the member \"{}\" stands twice in one object",
                                   printable(value.get_ref<const std::string&>(), 60)),
                       "remove one");
        return true;
    };
    try {
        return Json::parse(text.begin(), text.end(), watch);
    } catch (const Json::exception& error) {
        std::string_view what = error.what();
        if (const auto bracket = what.find("] "); bracket != std::string_view::npos) what.remove_prefix(bracket + 2);
        place.fail(printable(what, 200), "repair the JSON");
    }
}

// Formatting.

std::string json_text(std::string_view text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string json_number(double x) {
    if (!std::isfinite(x)) throw Error("a bundle cannot hold a number that is not finite; check matrices and depths");
    return fmt::format("{}", x == 0 ? 0.0 : x);  // no negative zero, which JSON parsers drop
}

std::string json_numbers(std::initializer_list<double> numbers) {
    std::vector<std::string> out;
    for (const double x : numbers) out.push_back(json_number(x));
    return fmt::format("[{}]", fmt::join(out, ", "));
}

std::string value_json(const bundle::Text&, const std::string& v) {
    return json_text(v);
}
std::string value_json(const bundle::Path&, const std::string& v) {
    return json_text(v);
}
std::string value_json(const bundle::Number&, double v) {
    return json_number(v);
}
std::string value_json(const bundle::Integer&, int v) {
    return fmt::format("{}", v);
}
std::string value_json(const bundle::Switch&, bool v) {
    return v ? "true" : "false";
}
std::string value_json(const bundle::Matrix&, const glm::dmat4& m) {
    return json_numbers({m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3], m[2][0], m[2][1],
                         m[2][2], m[2][3], m[3][0], m[3][1], m[3][2], m[3][3]});
}
std::string value_json(const bundle::Vector&, const glm::dvec3& v) {
    return json_numbers({v.x, v.y, v.z});
}
std::string value_json(const bundle::Pair&, const std::array<double, 2>& v) {
    return json_numbers({v[0], v[1]});
}
std::string value_json(const bundle::Warp&, const DepthWarp& w) {
    return json_numbers({w.middle_m, w.near_m, w.far_m, w.rise});
}
std::string value_json(const bundle::Region&, const BundleRegion& r) {
    return fmt::format("[{}, {}, {}, {}]", r.x, r.y, r.width, r.height);
}
std::string value_json(const bundle::Texts&, const std::vector<std::string>& v) {
    std::vector<std::string> out;
    for (const std::string& text : v) out.push_back(json_text(text));
    return fmt::format("[{}]", fmt::join(out, ", "));
}
std::string value_json(const bundle::Dictionary&, const std::map<std::string, std::string>& v) {
    std::vector<std::string> out;
    for (const auto& [key, text] : v) out.push_back(fmt::format("{}: {}", json_text(key), json_text(text)));
    return fmt::format("{{{}}}", fmt::join(out, ", "));
}
template <typename T>
std::string value_json(const bundle::ChoiceOf<T>& kind, const T& v) {
    for (const auto& [key, value] : kind.keys)
        if (value == v) return json_text(key);
    throw Error(fmt::format("a bundle cannot hold this choice; use one of {}", quoted_keys(kind.keys)));
}
std::string value_json(const bundle::BiasUnits&, const std::array<BiasUnit, 3>& v) {
    std::vector<std::string_view> out;
    for (const BiasUnit unit : v)
        for (const auto& [key, value] : bundle::kUnitKeys)
            if (value == unit) out.push_back(key);
    return json_text(fmt::format("{}", fmt::join(out, ", ")));
}

/// FrameWriter of one object of frame.json. Members with their defaults are left out.
class FrameWriter {
public:
    explicit FrameWriter(int depth) : depth_(depth) {}

    void version(const char* name, int known) { add(name, fmt::format("{}", known)); }
    template <typename Kind>
    void required(const char* name, const Kind& kind, const typename Kind::Type& member) {
        add(name, value_json(kind, member));
    }
    template <typename Kind>
    void value(const char* name, const Kind& kind, const typename Kind::Type& member,
               const typename Kind::Type& fallback) {
        if (member != fallback) add(name, value_json(kind, member));
    }
    template <typename Kind>
    void optional(const char* name, const Kind& kind, const std::optional<typename Kind::Type>& member) {
        if (member) add(name, value_json(kind, *member));
    }
    template <typename T>
    void object(const char* name, T& member) {
        if (member != T{}) add(name, object_text(member, depth_ + 1));
    }
    template <typename T>
    void required_object(const char* name, T& member) {
        add(name, object_text(member, depth_ + 1));
    }
    template <typename T>
    void optional_object(const char* name, std::optional<T>& member) {
        if (member) add(name, object_text(*member, depth_ + 1));
    }
    template <typename T>
    void list(const char* name, std::vector<T>& list, std::size_t, std::size_t) {
        std::vector<std::string> out;
        for (T& member : list) out.push_back(object_text(member, depth_ + 1));
        add(name, fmt::format("[{}]", fmt::join(out, ", ")));
    }

    template <typename T>
    static std::string object_text(T& object, int depth) {
        FrameWriter writer(depth);
        bundle::members(writer, object);
        if (writer.lines_.empty()) return "{}";
        const std::string end = "\n" + std::string(std::size_t(2 * depth), ' ');
        return fmt::format("{{{}{}}}", fmt::join(writer.lines_, ","), end);
    }

private:
    void add(const char* name, const std::string& text) {
        lines_.push_back(fmt::format("\n{}\"{}\": {}", std::string(std::size_t(2 * depth_ + 2), ' '), name, text));
    }
    int depth_;
    std::vector<std::string> lines_;
};

}  // namespace

Bundle parse_bundle(std::string_view text, std::string_view file) {
    const JsonPlace place{std::string(file), {}};
    if (text.size() > kMaxFrameJsonBytes)
        place.fail(fmt::format("the file has {} bytes", text.size()),
                   fmt::format("use at most {}", kMaxFrameJsonBytes));
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const Json root = parse_unique(place, text);
    Bundle out;
    FrameReader::read_object(root, place, out);
    return out;
}

std::string format_bundle(const Bundle& bundle) {
    Bundle copy = bundle;  // the description of members takes them to read and to write
    return FrameWriter::object_text(copy, 0) + "\n";
}

FirstRow first_row_of(const BundleImage& image) {
    if (image.first_row) return *image.first_row;
    const std::string extension = lower_extension(image.file);
    return extension == ".raw" || extension == ".pfm" ? FirstRow::Bottom : FirstRow::Top;
}

ViewChoice choice_of(const BundleLight& light) {
    if (light.choice) return *light.choice;
    if (light.maps.size() < 2) return ViewChoice::One;
    if (light.type == LightType::Point && light.maps.size() == 6) return ViewChoice::Face;
    const auto has_interval = [](const BundleMap& map) { return map.interval.has_value(); };
    return std::ranges::all_of(light.maps, has_interval) ? ViewChoice::Interval : ViewChoice::Map;
}

}  // namespace si
