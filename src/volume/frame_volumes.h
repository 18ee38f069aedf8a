#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// The shadow volumes of one frame, in clip space, ready to be drawn with identity matrices: for each volume
/// one run of triangles, counter-clockwise seen from outside, cut at the near plane and at the window's sides
/// and reaching to infinity (w = 0 before the projection).
struct FrameVolumes {
    std::vector<glm::vec4> vertices{};
    std::vector<std::size_t> begins{0};  ///< volume i is vertices [begins[i], begins[i + 1])

    std::size_t size() const { return begins.size() - 1; }
    std::span<const glm::vec4> operator[](std::size_t i) const {
        return std::span(vertices).subspan(begins[i], begins[i + 1] - begins[i]);
    }
};

/// @param lit      the lit casters; each is one volume, or one per lit triangle where it says so. Casters
///                 without any lit triangle have none, nor have those whose volume misses the window.
/// @param nearCap  close the volumes that touch the near rectangle with a near cap
FrameVolumes frameVolumes(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                          const View& view, bool nearCap);

/// Whether any volume touches the near rectangle, so that counting from 0 at the eye is wrong.
bool eyeInVolume(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                 const View& view);

}  // namespace gnomon
