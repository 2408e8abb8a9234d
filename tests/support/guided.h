// A guided preset as it is drawn, beside the truth: what its sentence claims is counted here.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "renderer/reference/metrics.h"
#include "tests/support/hard_case.h"

namespace si::test {

class Guided {
public:
    /// Draws the built-in preset `key`, with some settings changed ("KEY=VALUE").
    explicit Guided(const std::string& key, const std::vector<std::string>& changes = {}, int width = 160,
                    int height = 90);

    /// Node paths ("Boxes/Floor"); one that ends in * stands for all that begin so. Empty: all.
    using Nodes = std::set<std::string>;

    /// Of the pixels that are lit in truth, the share that is drawn dark.
    double wrongly_dark(const Nodes& receivers = {}) const;
    /// Of the pixels that one of the casters shadows in truth, the share that is drawn lit. No casters: any.
    double wrongly_lit(const Nodes& receivers = {}, const Nodes& casters = {}) const;
    /// How often neighbouring pixels of a row change between lit and dark on these receivers.
    int edges(const Nodes& receivers) const;
    /// Share of pixels with geometry whose visibility lies between shadow and light.
    double grey() const;
    /// Different grey levels between shadow and light, in steps of 1/1000.
    int grey_levels() const;
    /// Share of the pixels with geometry that are drawn dark.
    double dark() const;
    /// Of the pixels that `chosen` holds for, given map coordinates and depth, the share that is drawn lit; -1: none.
    double lit_where(const std::function<bool(const glm::dvec4& uvdw, bool shadow_in_reference)>& chosen) const;

    /// What is wrong in the whole picture, by cause.
    ErrorMetrics error() const;

    Scene scene;
    Settings settings;
    Shot shot;
    ByteImage map_view;  ///< what the map viewer shows
    /// Mean of what `value(x, y)` gives for the texels of the first map that something was drawn into.
    double mean_of_drawn(const std::function<double(int x, int y)>& value) const;

private:
    /// Whether the pixel's surface faces the light and belongs to the receivers.
    bool looked_at(std::size_t pixel, const Nodes& receivers) const;
    template <class Use>
    void each_pixel(const Nodes& receivers, Use use) const;
    bool shadowed(const RayReference& rays, const Hit& hit) const;

    /// Once something asks for them: every triangle is tried for every ray.
    const RayReference& rays() const;
    /// What each pixel shows.
    const std::vector<std::optional<Hit>>& hits() const;

    mutable std::vector<std::optional<Hit>> hits_;
    mutable std::optional<RayReference> rays_;
};

}  // namespace si::test
