#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gl/surface.h"
#include "image/image.h"
#include "matrix/lab.h"

namespace gnomon {

/// The buffer beside the colour buffer in which a mask stands while passes make it.
enum class MaskBuffer { None, Stencil, Alpha };

/// "stencil", "alpha"; "" for None.
const std::string& name(MaskBuffer);

/// The buffers as one pass left them.
struct StripPicture {
    std::size_t pass = 0;  ///< index into the plan's passes
    Image colour{};        ///< RGB
    Image mask{};          ///< one channel: stencil values, or 8 bits of alpha; empty for MaskBuffer::None
};

/// The plan that Lab::run() draws with what the lab simulates.
/// @pre @p axes are not automatic
Plan drawnPlan(Lab& lab, const Profile& profile, const Axes& axes, int width, int height, int frame);

/// The passes of @p plan that a film strip shows: all, but of more than @p mostVolumes volume passes the
/// first.
std::vector<std::size_t> stripPasses(const Plan& plan, std::size_t mostVolumes);

MaskBuffer maskBufferOf(const Plan& plan);

/// For Lab::run(): gives @p take the picture of each pass in @p passes, in order.
std::function<void(Surface&, std::size_t pass)> stripReader(std::vector<std::size_t> passes,
                                                            MaskBuffer buffer,
                                                            std::function<void(StripPicture)> take);

}  // namespace gnomon
