#include "tests/support/random_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string_view>

#include "renderer/scenes/builtin.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

constexpr std::array<const char*, 5> kScenes = {"boxes", "plane", "teapot", "relief", "figures"};

constexpr int kMaxMapTexels = 512;         ///< texels per side of a map
constexpr double kMaxBlurredTexels = 1e7;  ///< texels of all maps times the texels of their blur
constexpr int kMaxTaps = 512;              ///< taps of all lights per pixel

/// Generator that is equal everywhere, unlike the standard library's distributions.
class Chance {
public:
    explicit Chance(unsigned seed) : random_(seed) {
        for (int i = 0; i < 8; ++i) random_();
    }
    int below(int n) { return int(random_() % unsigned(n)); }
    double share() { return double(random_() % (1u << 24)) / double(1u << 24); }
    bool is(double probability) { return share() < probability; }
    double between(double lo, double hi) { return lo + (hi - lo) * share(); }

private:
    std::mt19937 random_;
};

/// Returns the largest random value of a setting. Some limits are low, because high values only make a case slow.
double max_random(const Param& p) {
    static const std::map<std::string_view, double> most = {{"map.resolution", kMaxMapTexels},
                                                            {"light_map.resolution", 64},
                                                            {"light_map.samples", 4},
                                                            {"truth.samples", 16},
                                                            {"contact.steps", 64}};
    const auto found = most.find(p.key);
    return found == most.end() ? p.max : std::min(p.max, found->second);
}

/// Returns whether a setting stays unchanged: texts, and settings that depend on the scene's file.
bool is_left_alone(const Param& p) {
    return is_text(p) || p.key == "scene.index" || p.key == "scene.animation" || p.key == "scene.time" ||
           p.key == "camera.index";
}

/// @param kind 0 to 9: one end of the range, zero, or a random value; some zeros save programs work
double random_number(int kind, Chance& chance, const Param& p, double standard) {
    const double least = p.min, most = max_random(p);
    if (p.unit == "deg" && kind < 3)
        return std::clamp(90.0 * std::round(chance.between(least, most) / 90), least, most);
    switch (kind) {
        case 3:
            return least;
        case 4:
            return most;
        case 5:
            return std::clamp(0.0, least, most);
        case 6:
            return chance.between(least, most);
        case 7:  // over all orders of magnitude
            return std::clamp((chance.is(0.5) && least < 0 ? -1 : 1) * std::pow(10.0, chance.between(-6, 8)), least,
                              most);
        default: {
            const double about = standard != 0 ? standard : std::min(1.0, most);
            return std::clamp(about * std::pow(10.0, chance.between(-1, 1)), least, most);
        }
    }
}

Value random_value(int kind, Chance& chance, const SettingRef& ref) {
    const Param& p = *ref.param;
    const Value standard = default_value(ref);
    if (std::holds_alternative<bool>(standard)) return chance.is(0.5);
    if (p.choices) return chance.below(int(p.choices().size()));
    if (const int* whole = std::get_if<int>(&standard))
        return int(std::lround(std::clamp(random_number(kind, chance, p, *whole), p.min, max_random(p))));
    return random_number(kind, chance, p, std::get<double>(standard));
}

/// Returns whether a setting selects programs or the number of images.
bool is_of_programs(const SettingRef& ref) {
    return !std::holds_alternative<double>(default_value(ref)) && ref.param->key != "map.resolution";
}

/// Sets some of the rows. @param share probability that a row changes
void set_rows(Settings& s, Chance& of_programs, Chance& of_numbers, double share, double view_share) {
    for (const SettingRef& ref : all_settings(s)) {
        if (is_left_alone(*ref.param) || ref.param->key == "light.count") continue;
        const double own = ref.param->key.starts_with("view.") ? view_share : share;
        // Every row draws a random number, so that a new row changes no other's value.
        const bool taken = of_programs.is(own);
        const int kind = of_programs.below(10);
        const Value value = random_value(kind, is_of_programs(ref) ? of_programs : of_numbers, ref);
        if (taken) set_value(s, ref, value);
    }
}

/// Aims the camera at the scene in most cases: an empty view tests little.
void aim(Settings& s, Chance& of_programs, Chance& chance, const Scene& scene) {
    const double radius = scene.bounds.radius();
    const glm::dvec3 centre = scene.bounds.centre();
    if (chance.is(0.8)) {
        CameraSettings& c = s.camera;
        if (c.source == CameraSource::Light && chance.is(0.5)) c.source = CameraSource::Manual;
        c.target_x = centre.x + chance.between(-0.5, 0.5) * radius;
        c.target_y = centre.y + chance.between(-0.5, 0.5) * radius;
        c.target_z = centre.z + chance.between(-0.5, 0.5) * radius;
        c.distance = radius * std::pow(10.0, chance.between(-0.5, 0.5));
        if (chance.is(0.8)) c.near = c.far = 0;
        c.height = radius * chance.between(0.5, 3);
        c.fov = chance.is(0.8) ? chance.between(20, 100) : c.fov;
    }
    for (int i = 0; i < s.light_count; ++i) {
        LightSettings& l = s.lights[std::size_t(i)];
        if (chance.is(0.7)) {
            set_target(l, centre);
            l.distance = chance.is(0.3) ? 0 : radius * chance.between(0.2, 4);
        }
        if (of_programs.is(0.7)) l.range = 0;
        if (of_programs.is(0.7)) l.intensity = 1;
    }
}

/// Reduces the settings to the cost that a case may have.
void make_cheap(Settings& s) {
    const int lights = std::max(s.light_count, 1);
    for (int* taps : {&s.filter.taps, &s.filter.blocker_taps, &s.filter.rays})
        *taps = std::min(*taps, std::max(kMaxTaps / lights, 1));
    double views = 0;
    for (int i = 0; i < s.light_count; ++i) {
        const LightSettings& l = s.lights[std::size_t(i)];
        views += l.type == LightType::Point ? 6 : l.type == LightType::Directional ? l.cascades : 1;
    }
    const double blurred = 1 + 2 * s.map.blur_texels + 2 * s.filter.blur + s.map.samples;
    while (s.map.resolution > 16 && views * blurred * s.map.resolution * s.map.resolution > kMaxBlurredTexels)
        s.map.resolution /= 2;
}

void set_objects(Settings& s, Chance& chance, const Scene& scene) {
    if (scene.objects.empty() || !chance.is(0.3)) return;
    for (int i = chance.below(3); i >= 0; --i) {
        const Object& object = scene.objects[std::size_t(chance.below(int(scene.objects.size())))];
        ObjectSettings& o = s.objects[scene.nodes[std::size_t(object.node)].path];
        o.cull = ObjectCull(chance.below(4));
        o.cast = chance.is(0.7);
        o.receive = chance.is(0.7);
    }
}

}  // namespace

const Scene& small_scene(const std::string& key) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(key);
    return found != scenes.end() ? found->second : scenes.emplace(key, load_scene(key)).first->second;
}

RandomCase random_case(unsigned seed) {
    Chance of_programs(0x51ed270bu + seed / kSeedsPerProgram), of_numbers(0x2545f491u ^ (seed * 2654435761u));
    RandomCase out{.scene = kScenes[std::size_t(of_programs.below(int(kScenes.size())))], .settings = {}};
    const Scene& scene = small_scene(out.scene);
    Settings& s = out.settings;
    constexpr int kLights[] = {1, 1, 1, 1, 1, 2, 2, 3, 0, 5};
    s.light_count = of_programs.is(0.02) ? kMaxLights : kLights[of_programs.below(int(std::size(kLights)))];
    // The share is small, medium or large.
    constexpr double kShares[] = {0.06, 0.25, 0.8};
    const double view_share = of_programs.is(0.3) ? 0.5 : 0;
    set_rows(s, of_programs, of_numbers, kShares[of_programs.below(3)], view_share);
    set_objects(s, of_programs, scene);
    // most behaviour depends on the kernel
    if (of_programs.is(0.7)) s.filter.kernel = of_programs.below(int(filters().size()));
    aim(s, of_programs, of_numbers, scene);
    if (s.map.resolution == Settings().map.resolution) s.map.resolution = 32 << of_numbers.below(4);
    make_cheap(s);
    return out;
}

}  // namespace si::test
