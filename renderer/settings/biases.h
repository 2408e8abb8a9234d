// Table of biases. A new bias is one row of this table and one GLSL file.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "renderer/gl/raster_traits.h"
#include "renderer/projection/depth_curve.h"
#include "renderer/settings/param.h"

namespace si {

/// Step of the shadow test that a bias changes.
enum class BiasStage {
    Compare,  ///< the compared depth; bias.kind chooses one row of this stage
    LookUp,   ///< the point of the look-up; acts in addition to bias.kind
    Raster,   ///< the stored depth, while the map is drawn; acts in addition to bias.kind
};

/// Numbers about one receiver from which a bias is computed on the CPU, in double precision. Counterpart of the struct
/// BiasInput in shaders/lib/bias.glsl.
struct BiasInput {
    DepthCurve curve;            ///< depth curve, of the light's view
    double texel_m = 1;          ///< texel size at the receiver, metres
    double n_dot_l = 1;          ///< cosine between the light and the normal chosen by bias.normal_source
    double z = 1;                ///< distance of the look-up's point along the light's axis, metres above 0
    PolygonOffset polygon;       ///< measured glPolygonOffset of the driver, for maps of this format
    glm::dvec2 per_texel{0};     ///< depth change of the receiver's plane per texel, along u and v
    double quantum = 0;          ///< depth step of the map format at the triangle's greatest depth
    double least_per_texel = 0;  ///< least depth bias of the plane if every texel has its own compared depth
    double least_common = 0;     ///< least depth bias of the plane if all texels share one compared depth
    bool in_map = true;          ///< the map holds the receiver's own face, which can then shadow itself
};

/// Starting value of a setting: the value that the setting gets when a person chooses another bias.kind.
struct StartingValue {
    std::string_view key;
    std::string_view value;  ///< text for set_setting()
};

/// Row of the bias table: one technique against self-shadowing. The GLSL functions of its file depend on its stage:
///   Compare  float depth_bias(BiasInput b): shift of the compared depth towards the light, depth-buffer units, >= 0.
///            With `per_texel` also vec2 reference_slope(BiasInput b): change of the compared depth per map width.
///            With `remainder` also float remainder_per_texel(BiasInput b): further shift towards the light for each
///            texel between the compared texel and the look-up's point, depth-buffer units.
///   LookUp   vec3 normal_offset(vec3 normal, vec3 to_light, float texel_m): shift of the look-up's point, metres.
///   Raster   float raster_offset(vec2 per_texel, float quantum): offset of stored depths away from the light, from
///            their change per texel and the format's depth step, depth-buffer units.
struct Bias {
    std::string_view key, label, help;
    std::string_view paper;  ///< source
    std::string_view file;   ///< GLSL file below shaders/
    BiasStage stage = BiasStage::Compare;
    std::span<const std::string_view> settings = {};  ///< keys of settings that a row reads only if it lists them
    std::span<const StartingValue> starts = {};       ///< values that choosing the row brings along (starting_values.h)
    bool per_texel = false;          ///< each texel has its own compared depth; a bilinear sampler has one for 4 texels
    bool gives_needed_bias = false;  ///< the row computes the needed bias by itself, whatever the bias settings are
    bool by_derivatives = false;     ///< the plane comes from screen derivatives of the position
    /// Returns the row's bias in closed form, depth-buffer units; for the normal offset the length of the shift,
    /// metres.
    double (*amount)(const BiasSettings&, const BiasInput&) = nullptr;
    /// Returns the further bias of a tap for each texel between tap and look-up, depth-buffer units. Rows with this
    /// function use the depth at the look-up where the plane falls away from the light. Null: no further bias.
    double (*remainder)(const BiasInput&) = nullptr;
};

/// Returns all rows of the bias table, one for each technique against self-shadowing.
std::span<const Bias> biases();
/// Returns the choices of the setting bias.kind, in its order. They are the rows of the bias table that change the
/// compared depth (BiasStage::Compare), which come first in the table.
std::span<const Choice> bias_choices();

/// Returns the row of the bias table that the setting bias.kind chooses.
const Bias& bias_of(const Settings& settings);
/// Returns the only row of the bias table whose bias changes this step of the shadow test: LookUp for the normal
/// offset, Raster for the polygon offset.
/// @param stage LookUp or Raster; for Compare, which has several rows, bias_of() returns the chosen one
const Bias& bias_of_stage(BiasStage stage);
/// Returns true when a bias reads the setting `key`. Either its row lists the key, or no row does, because the setting
/// belongs to all biases.
bool reads_setting(const Bias& row, std::string_view key);

/// Returns the vector by which the normal offset (bias.normal) moves a surface point before the look-up in the shadow
/// map, in metres.
/// @param normal unit vector, the one that bias.normal_source selects @param to_light unit vector
/// @param texel_m size of a shadow-map texel at the point, metres
glm::dvec3 normal_offset(const BiasSettings& bias, const glm::dvec3& normal, const glm::dvec3& to_light,
                         double texel_m);

/// Returns the amount of the slope-scaled bias, max(bias.slope (1 - n.l), bias.constant), in the unit of bias.unit.
/// @param n_dot_l cosine between normal and light
double slope_amount(const BiasSettings& bias, double n_dot_l);

}  // namespace si
