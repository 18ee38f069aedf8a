#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cost/traffic.h"
#include "plan/plan.h"

namespace gnomon {

/// What can bound a frame on an old chip.
enum class Resource : std::uint8_t {
    Fill,       ///< pixels per second
    Bandwidth,  ///< bytes per second of the frame buffer's memory; a frame on the chip pays nothing
    Triangles,  ///< per second
    Bus,        ///< to the host and back
    Host,       ///< the processor: the scene, silhouettes, volumes
};
constexpr int kResources = 5;

/// "fill", "bandwidth", "triangles", "bus", "host"
const std::string& name(Resource);

/// What one pass takes on a chip, milliseconds by resource; 0 where the profile lacks the rate.
struct PassCost {
    PassKind kind = PassKind::Clear;
    PassTraffic traffic{};
    double fillMs = 0, bandwidthMs = 0, triangleMs = 0, busMs = 0;

    double ms() const;                      ///< the largest: inside a pass they overlap
    std::optional<Resource> limit() const;  ///< which that is; nothing if the pass takes no time
};

/// What one frame takes on a chip, by a model of peak rates: the least that it can take, not a measurement.
///
/// A pass takes as long as the resource of which it needs most, and passes follow one another. The host works
/// on the next frame meanwhile: a frame takes as long as the slower of the two (in Table 2 of Roettger et al.
/// 2002 the unshadowed frame has one rate at 256x256 and 512x512, which a sum can't give).
struct FrameCost {
    std::vector<PassCost> passes{};
    double hostMs = 0;
    /// The rates that the frame calls for and the profile lacks: "no fill rate in the profile
    /// (megapixels_per_second)". What they would take is left out.
    std::vector<std::string> missing{};
    bool countsPassed = false;  ///< the fragments that passed were counted, not taken to be all

    bool isComplete() const { return missing.empty(); }
    double chipMs() const;  ///< sum of the passes
    double ms() const;
    double framesPerSecond() const;  ///< 0 if the frame takes no time
    std::int64_t bytes() const;      ///< in the frame buffer's memory
    /// The host, or the resource that limits the passes that take most of the chip's time together; nothing
    /// if the frame takes no time.
    std::optional<Resource> limit() const;
};

/// The cost of a pass that moves @p traffic. Rates that are 0 take no time.
PassCost passCost(PassKind kind, const PassTraffic& traffic, const Profile& profile);

/// @param amounts  of each pass
/// @param passed   of each pass: fragments that passed (Rendered::passSamples); empty: not known
/// @param hostMs   that the processor of the time needs for a frame; 0: it is not known, and left out
FrameCost frameCost(const Plan& plan, const Profile& profile, std::span<const DrawnAmount> amounts,
                    std::span<const std::int64_t> passed = {}, double hostMs = 0);

/// Whether @p profile has the rates without which times can't be compared: fill, and bandwidth unless the
/// frame is on the chip.
bool hasModelRates(const Profile& profile);

/// Milliseconds in whole nanoseconds, by which methods are ranked: sums in another order are the same.
std::int64_t rankedNs(const FrameCost& cost);

/// What the model takes from @p profile, with its source each: "fill 350 Mpixel/s [SYSREQ]", "bandwidth
/// nothing: the frame is on the chip [PSDEVWIKI]".
std::vector<std::string> modelRates(const Profile& profile);

}  // namespace gnomon
