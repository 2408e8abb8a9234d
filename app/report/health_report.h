// Search for NaN, infinite and out-of-range numbers in frames, for --check-numeric.
#pragma once

#include <memory>
#include <string>

#include "app/base/json_text.h"
#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

/// Draws a frame and searches its maps, visibility and matrices for invalid numbers (NaN, infinite, out of range).
/// Returns the findings.
/// @param workers threads for the rays that some light sources need @throws Error, Cancelled
std::shared_ptr<const NumericHealth> search_numbers(Renderer& renderer, const Scene& scene, const Settings& settings,
                                                    FrameRequest request, const Workers& workers = {});

/// Converts the findings of the search for invalid numbers (NaN, infinite, out of range) in a frame to JSON.
nlohmann::ordered_json health_json(const NumericHealth& health);

/// Checks that the search for invalid numbers (NaN, infinite, out of range) in a frame found none. @throws Error naming
/// each finding and its place
void require_sound(const NumericHealth& health);

/// Guard that searches every picture that a renderer draws for invalid numbers (NaN, infinite, out of range), as long
/// as the guard exists. Timed frames are left out.
class NumberWatch {
public:
    /// Starts to search a renderer's pictures. @param base settings; the message about a fault lists the differences
    /// from them @param on false: no picture is searched
    NumberWatch(Renderer& renderer, Settings base, bool on);
    ~NumberWatch();
    NumberWatch(const NumberWatch&) = delete;
    NumberWatch& operator=(const NumberWatch&) = delete;

    /// Checks that no picture drawn so far held an invalid number. Call at the end of a command. @throws Error naming
    /// the first faulty picture's settings, the fault and its place
    void require_sound() const;

private:
    Renderer& renderer_;
    const Settings base_;
    const bool on_;
    std::string first_;  ///< message of the first fault; empty: none
    std::size_t frames_ = 0, unsound_ = 0;
};

}  // namespace si
