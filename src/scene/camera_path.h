#pragma once

#include <vector>

#include "scene/scene.h"

namespace gnomon {

/// @p count cameras along a scene's path, evenly spread over its frames. A scene of one frame gets a path: an
/// eye outside of its casters' bounding box goes once around the vertical through their middle and looks at
/// it as before; an eye within walks an ellipse of a third of the box's sides at its height and looks ahead.
/// Near planes are as far out as they can be (nearPlaneFor()).
/// @pre count >= 1
std::vector<Camera> cameraPath(const Scene& scene, int count);

}  // namespace gnomon
