#include "plan/plan.h"

namespace gnomon {

PassCounts countPasses(const Plan& plan) {
    PassCounts counts;
    for (const Pass& pass : plan.passes) {
        switch (pass.kind) {
            case PassKind::Clear:
                break;
            case PassKind::Scene:
                ++counts.scene;
                break;
            case PassKind::Volume:
                ++counts.volume;
                break;
            case PassKind::Rectangle:
                ++counts.rectangle;
                break;
            case PassKind::Copy:
                ++counts.copy;
                break;
        }
    }
    return counts;
}

}  // namespace gnomon
