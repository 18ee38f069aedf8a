#include "profile/profile.h"

#include <algorithm>

namespace gnomon {

namespace {

/// The fact @p key; null if there is none.
const Profile::Fact* find(const std::vector<Profile::Fact>& facts, const std::string& key) {
    const auto fact =
        std::find_if(facts.begin(), facts.end(), [&](const Profile::Fact& f) { return f.key == key; });
    return fact == facts.end() ? nullptr : &*fact;
}

}  // namespace

std::string Profile::sourceOf(const std::string& key) const {
    const Fact* fact = find(facts, key);
    return fact ? fact->source : "not in the profile";
}

Evidence Profile::gradeOf(const std::string& key) const {
    const Fact* fact = find(facts, key);
    return fact ? fact->grade : Evidence::Guess;
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
