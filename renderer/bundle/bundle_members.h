// Description of frame.json, from which parser, formatter and JSON schema follow: each member once, with its kind.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/bundle/bundle.h"

namespace si::bundle {

// Kinds of values. Io classes know how each is read, written and described.

/// Schema of a value in frame.json (an engine's exported frame): a text of at most `max_bytes` bytes.
struct Text {
    using Type = std::string;
    std::size_t max_bytes = 4096;
};
/// Schema of a value in frame.json (an engine's exported frame): the name of a file in the bundle.
struct Path {
    using Type = std::string;
};
/// Schema of a value in frame.json (an engine's exported frame): a number from `least` to `most`; greater than `least`
/// if `above` is true.
struct Number {
    using Type = double;
    double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();
    bool above = false;
};
/// Schema of a value in frame.json (an engine's exported frame): a whole number from `least` to `most`.
struct Integer {
    using Type = int;
    int least = 0, most = std::numeric_limits<int>::max();
};
/// Schema of a value in frame.json (an engine's exported frame): true or false.
struct Switch {
    using Type = bool;
};
/// Schema of a value in frame.json (an engine's exported frame): a 4 x 4 matrix as sixteen numbers, column by column.
struct Matrix {
    using Type = glm::dmat4;
};
/// Schema of a value in frame.json (an engine's exported frame): a vector of three numbers.
struct Vector {
    using Type = glm::dvec3;
};
/// Schema of a value in frame.json (an engine's exported frame): two numbers from `least` to `most`, the first below
/// the second. They may be equal if `may_equal` is true.
struct Pair {
    using Type = std::array<double, 2>;
    double least = -std::numeric_limits<double>::max(), most = std::numeric_limits<double>::max();
    bool may_equal = false;
};
/// Schema of a value in frame.json (an engine's exported frame): depth ranges of the rows of a warped map (LiSPSM), as
/// the numbers middle, near, far and rise (DepthWarp).
struct Warp {
    using Type = DepthWarp;
};
/// Schema of a value in frame.json (an engine's exported frame): a rectangle of texels as x, y, width and height.
struct Region {
    using Type = BundleRegion;
};
/// Schema of a value in frame.json (an engine's exported frame): a list of at most `most` texts.
struct Texts {
    using Type = std::vector<std::string>;
    std::size_t most = 100'000;
};
/// Schema of a value in frame.json (an engine's exported frame): an object with any keys, whose values are texts,
/// numbers or booleans.
struct Dictionary {
    using Type = std::map<std::string, std::string>;
};
/// Schema of a value in frame.json (an engine's exported frame): the units of the bias terms constant, slope and normal
/// in one text, separated by commas.
struct BiasUnits {
    using Type = std::array<BiasUnit, 3>;
};
/// Schema of a value in frame.json (an engine's exported frame): one key of a fixed list, which stands for an
/// enumerator.
template <typename T>
struct ChoiceOf {
    using Type = T;
    std::span<const std::pair<std::string_view, T>> keys;
};
template <typename T, std::size_t size>
ChoiceOf(const std::array<std::pair<std::string_view, T>, size>&) -> ChoiceOf<T>;

using std::pair;
using Key = std::string_view;

inline constexpr std::array kUpKeys = {pair(Key("y"), UpAxis::Y),       pair(Key("x"), UpAxis::X),
                                       pair(Key("z"), UpAxis::Z),       pair(Key("-x"), UpAxis::MinusX),
                                       pair(Key("-y"), UpAxis::MinusY), pair(Key("-z"), UpAxis::MinusZ)};
inline constexpr std::array kHandKeys = {pair(Key("right"), false), pair(Key("left"), true)};
inline constexpr std::array kRangeKeys = {pair(Key("0..1"), true), pair(Key("-1..1"), false)};
inline constexpr std::array kTypeKeys = {pair(kLightTypeKeys[0], LightType::Directional),
                                         pair(kLightTypeKeys[1], LightType::Spot),
                                         pair(kLightTypeKeys[2], LightType::Point)};
inline constexpr std::array kChoiceKeys = {pair(Key("one"), ViewChoice::One), pair(Key("map"), ViewChoice::Map),
                                           pair(Key("interval"), ViewChoice::Interval),
                                           pair(Key("face"), ViewChoice::Face)};
inline constexpr std::array kFirstRowKeys = {pair(Key("bottom"), FirstRow::Bottom), pair(Key("top"), FirstRow::Top)};
inline constexpr std::array kRawKeys = {pair(Key("f32"), RawFormat::F32), pair(Key("f16"), RawFormat::F16),
                                        pair(Key("u16"), RawFormat::U16), pair(Key("u24"), RawFormat::U24),
                                        pair(Key("u32"), RawFormat::U32)};
inline constexpr std::array kStoredKeys = {
    pair(Key("depth"), BundleStored::Depth),
    pair(Key("linear"), BundleStored::Linear),
    pair(Key("axis-metres"), BundleStored::AxisMetres),
    pair(Key("distance-metres"), BundleStored::DistanceMetres),
    pair(Key("distance-share"), BundleStored::DistanceShare),
    pair(Key("exponential"), BundleStored::Exponential),
    pair(Key("moments"), BundleStored::Moments),
};
inline constexpr std::array kFormatKeys = {
    pair(Key("d16"), BundleDepthFormat::D16), pair(Key("d24"), BundleDepthFormat::D24),
    pair(Key("d32f"), BundleDepthFormat::D32F), pair(Key("r16f"), BundleDepthFormat::R16F),
    pair(Key("r32f"), BundleDepthFormat::R32F)};
inline constexpr std::array kCullKeys = {pair(Key("none"), Cull::None), pair(Key("back"), Cull::Back),
                                         pair(Key("front"), Cull::Front)};
inline constexpr std::array kFrontKeys = {pair(Key("ccw"), BundleFront::Ccw), pair(Key("cw"), BundleFront::Cw)};
inline constexpr std::array kUnitKeys = {pair(Key("depth"), BiasUnit::Depth), pair(Key("texels"), BiasUnit::Texels),
                                         pair(Key("metres"), BiasUnit::Metres)};
inline constexpr std::array kNormalByKeys = {pair(Key("length"), OffsetBy::Length), pair(Key("sine"), OffsetBy::Sine),
                                             pair(Key("one-minus-cosine"), OffsetBy::OneMinusCosine),
                                             pair(Key("sideways"), OffsetBy::Sideways)};
inline constexpr std::array kCompareKeys = {
    pair(Key("less"), BundleCompare::Less), pair(Key("less-equal"), BundleCompare::LessEqual),
    pair(Key("greater"), BundleCompare::Greater), pair(Key("greater-equal"), BundleCompare::GreaterEqual)};
inline constexpr std::array kFilterKeys = {pair(Key("nearest"), BundleFilter::Nearest),
                                           pair(Key("linear"), BundleFilter::Linear)};
inline constexpr std::array kWrapKeys = {pair(Key("border"), BundleWrap::Border), pair(Key("clamp"), BundleWrap::Clamp),
                                         pair(Key("repeat"), BundleWrap::Repeat)};

// Io has: version(), required(name, kind, member), value(name, kind, member, fallback), optional(name, kind, member),
// object(name, member), required_object(name, member), optional_object(name, member), list(name, members, least, most).

template <typename Io>
void members(Io& io, BundleMatrix& m) {
    io.optional("clip_from_world", Matrix{}, m.clip_from_world);
    io.optional("view", Matrix{}, m.view);
    io.optional("world_from_view", Matrix{}, m.world_from_view);
    io.optional("projection", Matrix{}, m.projection);
}

template <typename Io>
void members(Io& io, BundleWorld& w) {
    const BundleWorld fallback;
    io.value("up", ChoiceOf{kUpKeys}, w.up, fallback.up);
    io.value("hand", ChoiceOf{kHandKeys}, w.left_handed, fallback.left_handed);
    io.value("metres_per_unit", Number{.least = 0, .most = 1e12, .above = true}, w.metres_per_unit,
             fallback.metres_per_unit);
    io.value("origin", Vector{}, w.origin, fallback.origin);
}

template <typename Io>
void members(Io& io, DepthConvention& d) {
    io.required("range", ChoiceOf{kRangeKeys}, d.zero_to_one);
    io.value("reversed", Switch{}, d.reversed, false);
}

template <typename Io>
void members(Io& io, BundleCamera& c) {
    members(io, c.clip);
    io.required("width", Integer{1, 65536}, c.width);
    io.required("height", Integer{1, 65536}, c.height);
    io.required_object("depth", c.depth);
}

template <typename Io>
void members(Io& io, BundleImage& i) {
    const BundleImage fallback;
    io.required("file", Path{}, i.file);
    io.optional("first_row", ChoiceOf{kFirstRowKeys}, i.first_row);
    io.value("width", Integer{1, kMaxBundleImageSide}, i.width, fallback.width);
    io.value("height", Integer{1, kMaxBundleImageSide}, i.height, fallback.height);
    io.optional("format", ChoiceOf{kRawKeys}, i.format);
    io.value("channels", Integer{1, 4}, i.channels, fallback.channels);
    io.value("channel", Integer{0, 3}, i.channel, fallback.channel);
}

template <typename Io>
void members(Io& io, BundleDepth& d) {
    const BundleDepth fallback;
    members(io, d.convention);
    io.value("stored", ChoiceOf{kStoredKeys}, d.stored, fallback.stored);
    io.value("format", ChoiceOf{kFormatKeys}, d.format, fallback.format);
    io.optional("range_m", Number{.least = 0, .above = true}, d.range_m);
    io.optional("exponent", Number{.least = 0, .above = true}, d.exponent);
    io.optional("clear", Number{}, d.clear);
    io.optional("planes_m", Pair{}, d.planes_m);
    io.optional("warp", Warp{}, d.warp);
}

template <typename Io>
void members(Io& io, BundleRaster& r) {
    io.optional("offset_factor", Number{}, r.offset_factor);
    io.optional("offset_units", Number{}, r.offset_units);
    io.optional("offset_clamp", Number{}, r.offset_clamp);
    io.optional("cull", ChoiceOf{kCullKeys}, r.cull);
    io.optional("front", ChoiceOf{kFrontKeys}, r.front);
    io.optional("depth_clamp", Switch{}, r.depth_clamp);
    io.optional("shift_m", Number{}, r.shift_m);
    io.optional("grazing_shift_m", Number{}, r.grazing_shift_m);
}

template <typename Io>
void members(Io& io, BundleMap& m) {
    io.required_object("image", m.image);
    io.optional("region", Region{}, m.region);
    members(io, m.clip);
    io.required_object("depth", m.depth);
    io.object("raster", m.raster);
    io.optional("interval", Pair{}, m.interval);
    io.optional("edge", Pair{.least = 0, .most = 0.5, .may_equal = true}, m.edge);
    io.optional("drawn", Texts{}, m.drawn);
}

template <typename Io>
void members(Io& io, BundleBias& b) {
    const BundleBias fallback;
    io.optional("constant", Number{}, b.constant);
    io.optional("slope", Number{}, b.slope);
    io.optional("normal", Number{}, b.normal);
    io.value("units", BiasUnits{}, b.units, fallback.units);
    io.value("normal_by", ChoiceOf{kNormalByKeys}, b.normal_by, fallback.normal_by);
}

template <typename Io>
void members(Io& io, BundleLookup& l) {
    io.object("bias", l.bias);
    io.optional("kernel", Text{}, l.kernel);
    io.optional("compare", ChoiceOf{kCompareKeys}, l.compare);
    io.optional("filter", ChoiceOf{kFilterKeys}, l.filter);
    io.optional("wrap", ChoiceOf{kWrapKeys}, l.wrap);
    io.value("shader", Path{}, l.shader, "");
}

template <typename Io>
void members(Io& io, BundleLight& l) {
    io.value("name", Text{}, l.name, "");
    io.required("type", ChoiceOf{kTypeKeys}, l.type);
    io.optional("direction", Vector{}, l.direction);
    io.optional("position", Vector{}, l.position);
    io.optional("cone_deg", Number{.least = 0, .most = 360, .above = true}, l.cone_deg);
    io.optional("choice", ChoiceOf{kChoiceKeys}, l.choice);
    io.value("closed", Switch{}, l.closed, false);
    io.list("maps", l.maps, 0, kMaxBundleMaps);
    io.object("lookup", l.lookup);
}

template <typename Io>
void members(Io& io, Bundle& b) {
    io.version("bundle", 1);
    io.value("made_by", Text{}, b.made_by, "");
    io.value("scene", Path{}, b.scene, "");
    io.object("world", b.world);
    io.optional_object("camera", b.camera);
    io.value("picture", Path{}, b.picture, "");
    io.list("lights", b.lights, 1, std::size_t(kMaxLights));
    io.value("notes", Texts{1000}, b.notes, {});
    io.value("settings", Dictionary{}, b.settings, {});
}

}  // namespace si::bundle
