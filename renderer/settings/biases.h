// The table of biases: a new one is one row here and one GLSL file.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "renderer/gl/raster_traits.h"
#include "renderer/projection/depth_curve.h"
#include "renderer/settings/param.h"

namespace si {

/// Where a bias acts.
enum class BiasStage {
    Compare,  ///< on the depth that is compared: bias.kind chooses one of these
    LookUp,   ///< moves the point that is looked up; acts beside the others
    Raster,   ///< on the depth that is stored, while the map is drawn; acts beside the others
};

/// What a bias may know of a receiver: shaders/lib/bias.glsl in double.
struct BiasInput {
    DepthCurve curve;         ///< of the receiver's view
    double texel_m = 1;       ///< world size of a texel at the receiver
    double n_dot_l = 1;       ///< of the normal that bias.normal_source chooses
    double z = 1;             ///< metres along the view's axis, above 0, of the point that is looked up
    PolygonOffset polygon;    ///< what the driver makes of glPolygonOffset in maps of this format
    glm::dvec2 per_texel{0};  ///< depth of the receiver's plane per texel, along u and v
    double quantum = 0;       ///< step of the stored depth
    double rest = 0;          ///< depth: the plane's least bias where every texel is compared with the plane there
    double least = 0;         ///< depth: the plane's least bias where one depth is compared with all texels
};

/// A bias. The functions of its file, below shaders/, are by its stage
///   Compare  float depth_bias(BiasInput b), depth-buffer units, at least 0: how far the compared depth comes nearer
///            to the light; where `per_texel`, also vec2 reference_slope(BiasInput b): by how much that depth grows per
///            map width, with which every texel is compared at its own place
///   LookUp   vec3 normal_offset(vec3 normal, float texel_m), metres: where the point that is looked up moves
///   Raster   float raster_offset(vec2 per_texel, float quantum), depth-buffer units: what the map's depths recede by
struct Bias {
    std::string_view key, label, help;
    std::string_view paper;  ///< where it comes from
    std::string_view file;
    BiasStage stage = BiasStage::Compare;
    std::span<const std::string_view> settings = {};  ///< keys that only it and other rows that list them read
    bool per_texel = false;  ///< each texel is compared with a depth of its own; bilinear samplers have one for 4
    bool gives_needed_bias = false;  ///< it gives what a plane needs by itself, whatever the numbers are
    bool by_derivatives = false;     ///< it has the plane from the steps of the surface between neighbouring pixels
    /// The same in closed form, in what the file's function counts in; of a look-up's move its length.
    double (*amount)(const BiasSettings&, const BiasInput&) = nullptr;
};

std::span<const Bias> biases();
std::span<const Choice> bias_choices();  ///< of bias.kind: the rows of stage Compare, which come first

/// The row that bias.kind chooses.
const Bias& bias_of(const Settings& settings);
/// The row of a stage that has but one.
const Bias& bias_of_stage(BiasStage stage);
/// Whether the row reads a setting, or all rows do.
bool reads_setting(const Bias& row, std::string_view key);

/// The lectures' bias, max(slope (1 - n.l), constant), in bias.unit.
double slope_amount(const BiasSettings& bias, double n_dot_l);

}  // namespace si
