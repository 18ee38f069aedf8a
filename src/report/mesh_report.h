#pragma once

#include <string>
#include <vector>

#include "report/page.h"
#include "volume/mesh_facts.h"

namespace gnomon {

/// What the topology of meshes means for shadow volumes. JSON has one object per mesh, CSV one line per mesh,
/// set of lights and silhouette.
std::string showMeshes(const std::vector<MeshFacts>& meshes, const Page& page);

}  // namespace gnomon
