#include "method/shader_volumes.h"

namespace gnomon {

Plan withShaderVolumes(Plan plan) {
    for (Pass& pass : plan.passes) {
        if (pass.kind != PassKind::Volume || pass.drawn != Drawn::Volumes) continue;
        pass.drawn = Drawn::Silhouettes;
        pass.parts = {};
        pass.depthClamp = true;
        pass.label = "sides and far caps that a geometry shader makes: count +1 and -1";
    }
    return plan;
}

}  // namespace gnomon
