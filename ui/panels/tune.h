// The search for the least bias: what its controls are set to, what it found, what they wish for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "renderer/measure/frame_costs.h"
#include "renderer/settings/settings.h"

namespace si {

/// The limits of a search, as they are being typed.
struct TunePanel {
    bool bound_error = true, bound_ms = false, area = false;
    double most_error = 0.01, most_ms = 10;
    CostCase cost = kDefaultCost;
};

/// A search for the least bias, under way.
struct SearchProgress {
    std::string about;    ///< what is being tried
    double progress = 0;  ///< 0..1
};

/// What a search is to find: without limits the least bias that leaves no acne.
struct TuneRequest {
    std::optional<double> most_error, most_ms;  ///< then kernel and resolution are searched, too
    bool area = false;                          ///< against a light of its size
    CostCase cost = kDefaultCost;               ///< which frames most_ms bounds
};

/// What a search for the least bias found of one way to spend it.
struct TunedFamily {
    std::string name, bias_text;
    BiasSettings bias;
    std::size_t acne = 0, wrong = 0, lost = 0;  ///< pixels; lost: wrong by the price of bias
    double gap_p95_m = 0, shift_p95_m = 0;      ///< lit strip at contacts; how far edges are moved
    bool chosen = false;
};

struct TunePanelFacts {
    std::optional<SearchProgress> tuning;
    std::span<const TunedFamily> tuned;  ///< all that the last search for the least bias tried, for this scene
    bool tuned_current = false;          ///< the present settings, whatever their bias, would give the same
};

struct TuneRequests {
    std::optional<TuneRequest> tune;
    bool cancel_tune = false;
};

}  // namespace si
