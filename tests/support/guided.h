// A guided preset as drawn, with what its claims measure.
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

/// One drawing of a claim. Rays are traced when a metric first needs them: each is tried against every triangle.
class Guided {
public:
    /// @param key preset of subjects that name none
    Guided(const std::string& key, const ClaimSubject& subject);

    using Nodes = std::vector<std::string>;

    /// Share of drawn-dark pixels among those of the receivers that are lit in the reference.
    double wrongly_dark(const Nodes& receivers) const;
    /// Share of drawn-lit pixels among those of the receivers that one of the casters shadows in the reference.
    double wrongly_lit(const Nodes& receivers, const Nodes& casters) const;
    /// Number of changes between lit and dark from pixel to pixel of a row, on the receivers.
    int edges(const Nodes& receivers) const;
    /// Share of pixels with geometry whose visibility lies between shadow and light.
    double grey() const;
    /// Number of grey levels between shadow and light, in steps of 1/1000.
    int grey_levels() const;
    /// Share of drawn-dark pixels among those with geometry.
    double dark() const;
    /// Share of drawn-lit pixels among those that `chosen` holds for; -1 if there are none.
    double lit_where(const std::function<bool(const glm::dvec4& uvdw, bool shadow_in_reference)>& chosen) const;
    /// Mean of `value(x, y)` over the texels of the first map that something was drawn into.
    double mean_of_drawn(const std::function<double(int x, int y)>& value) const;

    /// Means over pixels that no edge of a shadow is near: visibility in shadow, and 1 - visibility in light.
    struct MeanErrors {
        double bled = 0;
        double darkened = 0;
    };
    MeanErrors mean_errors() const;

    /// Errors of the whole picture, by cause.
    const ErrorMetrics& error() const;
    /// The same drawing without anything cached.
    const Classification& classification() const;

    Scene scene;
    Settings settings;
    Shot shot;
    ByteImage map_view;  ///< picture of the map viewer

private:
    /// Returns whether the pixel's surface faces the light and belongs to the receivers.
    bool counts(std::size_t pixel, const Nodes& receivers) const;
    template <class Use>
    void each_pixel(const Nodes& receivers, Use use) const;
    bool shadowed(const RayReference& rays, const Hit& hit) const;

    const RayReference& rays() const;
    /// First hit of each pixel's ray.
    const std::vector<std::optional<Hit>>& hits() const;

    mutable std::vector<std::optional<Hit>> hits_;
    mutable std::optional<RayReference> rays_;
    mutable std::optional<ErrorMetrics> error_;
    mutable std::optional<Classification> classification_;
};

}  // namespace si::test
