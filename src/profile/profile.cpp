#include "profile/profile.h"

#include <algorithm>

namespace gnomon {

std::string Profile::sourceOf(const std::string& key) const {
    const auto fact = std::find_if(facts.begin(), facts.end(), [&](const Fact& f) { return f.key == key; });
    return fact == facts.end() ? "not in the profile" : fact->source;
}

BlendUnit Profile::blendUnit() const {
    return blendUnits.empty() ? BlendUnit::IdealRound : blendUnits.front();
}

bool Profile::allowsBlend(BlendFactor source, BlendFactor destination) const {
    return (sourceFactors.contains(source) && destinationFactors.contains(destination)) ||
           blendPairs.contains({source, destination});
}

bool Profile::allowsBlendWithConstantSource(BlendFactor source, BlendFactor destination) const {
    return allowsBlend(source, destination) || constantSourcePairs.contains({source, destination});
}

}  // namespace gnomon
