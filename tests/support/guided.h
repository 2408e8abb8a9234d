// Draws guided presets and measures the drawings for claims.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/claims.h"
#include "renderer/measure/measure.h"
#include "renderer/reference/metrics.h"
#include "tests/support/hard_case.h"

namespace si::test {

/// Drawing of a guided preset with the metrics that its claims use. Reference rays test every triangle, so a metric
/// traces them on first use.
class GuidedDrawing {
public:
    /// Draws the preset that the subject names, with the subject's changes of settings.
    /// @param key preset to draw if the subject names none
    GuidedDrawing(const std::string& key, const ClaimSubject& subject);

    /// Paths of scene nodes; a path includes all objects below the node.
    using Nodes = std::vector<std::string>;

    /// Returns the share of false shadow: drawn-dark pixels among the receivers' pixels that are lit in the reference.
    double wrongly_dark(const Nodes& receivers) const;
    /// Returns the share of false light: drawn-lit pixels among the receivers' pixels that one of the casters shadows
    /// in the reference.
    double wrongly_lit(const Nodes& receivers, const Nodes& casters) const;
    /// Counts shadow edges on the receivers: changes between lit and dark along rows of pixels.
    int edges(const Nodes& receivers) const;
    /// Returns the share of partly lit pixels (visibility between 0 and 1) among pixels with geometry.
    double grey() const;
    /// Counts the distinct visibilities between 0 and 1, in steps of 1/1000.
    int grey_levels() const;
    /// Returns the share of drawn-dark pixels among pixels with geometry.
    double dark() const;
    /// Returns the share of drawn-lit pixels among the pixels that `chosen` accepts; -1 if `chosen` accepts none.
    /// @param chosen filter by map coordinates (u, v), depth and w, and by the reference
    double lit_where(const std::function<bool(const glm::dvec4& uvdw, bool shadow_in_reference)>& chosen) const;
    /// Returns the mean of `value(x, y)` over those texels of the first map that hold a caster.
    double mean_of_drawn(const std::function<double(int x, int y)>& value) const;

    /// Mean errors over pixels away from shadow edges.
    struct MeanErrors {
        double bled = 0;      ///< mean visibility in shadow
        double darkened = 0;  ///< mean of 1 - visibility in light
    };
    /// Returns the mean errors in shadow and in light, away from shadow edges.
    MeanErrors mean_errors() const;

    /// Returns the error metrics of the whole picture, by cause.
    const ErrorMetrics& error() const;
    /// Returns the classification of all pixels, measured on a second drawing without caches.
    const Classification& classification() const;

    Scene scene;
    Settings settings;
    Shot shot;
    ByteImage map_view;  ///< picture shown by the map viewer

private:
    /// Returns whether a pixel belongs to the receivers and faces the light.
    bool counts(std::size_t pixel, const Nodes& receivers) const;
    /// Calls `use(hit, visibility)` for each pixel that counts() accepts.
    template <class Use>
    void each_pixel(const Nodes& receivers, Use use) const;
    /// Returns whether the light's rays to a hit are blocked in the reference.
    bool shadowed(const RayReference& rays, const Hit& hit) const;

    /// Returns the reference rays of the scene, prepared on first use.
    const RayReference& rays() const;
    /// Returns the first hit of each pixel's ray, row by row from the top.
    const std::vector<std::optional<Hit>>& hits() const;

    mutable std::vector<std::optional<Hit>> hits_;
    mutable std::optional<RayReference> rays_;
    mutable std::optional<ErrorMetrics> error_;
    mutable std::optional<Classification> classification_;
};

}  // namespace si::test
