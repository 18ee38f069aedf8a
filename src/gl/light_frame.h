#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "gl/depth_map.h"
#include "gl/frame.h"
#include "gl/silhouette_mesh.h"
#include "volume/frame_volumes.h"

namespace gnomon {

/// All that one light adds to a frame. What no pass of the plan draws may stay empty.
struct LightFrame {
    std::shared_ptr<const LightColours> colours{};
    std::shared_ptr<const FrameVolumes> volumes{};
    std::vector<glm::vec4> blockers{};  ///< eyeBlockers()
    SilhouetteMesh silhouettes{};       ///< for a geometry shader
    DepthMapFrame depthMap{};
};

/// Gives what a light adds; the reference is valid until another light is asked for.
using LightFrames = std::function<const LightFrame&(int light)>;

}  // namespace gnomon
