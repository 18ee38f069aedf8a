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

bool passes(Compare function, float value, float reference) {
    switch (function) {
        case Compare::Never:
            return false;
        case Compare::Less:
            return value < reference;
        case Compare::Equal:
            return value == reference;
        case Compare::Lequal:
            return value <= reference;
        case Compare::Greater:
            return value > reference;
        case Compare::Notequal:
            return value != reference;
        case Compare::Gequal:
            return value >= reference;
        case Compare::Always:
            return true;
    }
    return true;
}

}  // namespace gnomon
