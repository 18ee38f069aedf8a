#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/view.h"
#include "volume/volume.h"
#include "volume/volume_cut.h"

namespace gnomon {

/// The shadow volumes of one frame under one light, in clip space, ready to be drawn with identity matrices:
/// for each volume and part one run of triangles, counter-clockwise seen from outside. Unless another clip is
/// asked for, they are cut at the near plane and at the window's sides.
struct FrameVolumes {
    /// One part of all volumes; that of volume i is vertices [begins[i], begins[i + 1]).
    struct Runs {
        std::vector<glm::vec4> vertices{};
        std::vector<std::size_t> begins{0};
    };
    std::array<Runs, kParts> parts{};
    /// Of each volume, its place among all that the light makes, those outside of the window too: one for
    /// each caster with lit triangles, or for each of these.
    std::vector<std::uint32_t> ordinals{};

    std::size_t size() const { return parts[0].begins.size() - 1; }
    std::span<const glm::vec4> all(Part part) const { return parts[std::size_t(part)].vertices; }
    std::span<const glm::vec4> of(Part part, std::size_t volume) const {
        const Runs& runs = parts[std::size_t(part)];
        return all(part).subspan(runs.begins[volume], runs.begins[volume + 1] - runs.begins[volume]);
    }
};

/// @param lit    the lit casters; each is one volume, or one per lit triangle where it says so. Casters
///               without any lit triangle have none, nor have those of whose parts none is in the window.
/// @param parts  what is wanted; only volumes that touch the near rectangle get a near cap
FrameVolumes frameVolumes(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                          const View& view, Parts parts, const CutStyle& style = {});

/// Those of @p volumes whose ordinals are @p ordinals, in that order. One that is not there has no faces.
FrameVolumes only(const FrameVolumes& volumes, std::span<const std::uint32_t> ordinals);

/// Whether any volume touches the near rectangle, so that counting from 0 at the eye is wrong.
bool eyeInVolume(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                 const View& view);

}  // namespace gnomon
