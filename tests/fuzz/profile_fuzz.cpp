// A profile: all that the rest of gnomon takes for granted holds, or it is refused in one line.

#include "fuzz.h"
#include "profile/check.h"
#include "profile/profile.h"

namespace gnomon::fuzz {
namespace {

void checkProfile(const Profile& profile) {
    require(!profile.title.empty() && isOneLine(profile.title), "title");
    require(contradictions(profile).empty(), "contradictions");
    for (const Profile::Source& source : profile.sources)
        require(isOneLine(source.key) && isOneLine(source.document), "source");
    for (const Profile::Fact& fact : profile.facts) {
        require(isOneLine(fact.key) && isOneLine(fact.value) && isOneLine(fact.source), "fact");
        require(!fact.source.empty() && profile.sourceOf(fact.key) == fact.source, "source of a fact");
    }
    for (const ColourFormat& format : profile.colourFormats)
        require(!format.name.empty() && format.red > 0, "colour format");
    for (const int bits : profile.depthBits) require(bits >= 1 && bits <= 32, "depth bits");
    require(profile.depth == !profile.depthBits.empty(), "depth");
    for (const int count :
         {profile.alphaBits, profile.stencilBits, profile.textureUnits, profile.maxTextureSize,
          profile.maxTextureAspect, profile.clipPlanes, profile.maxWidth, profile.maxHeight})
        require(count >= 0 && count <= 65536, "count");
    for (const double rate : {profile.megapixelsPerSecond, profile.megatrianglesPerSecond,
                              profile.gigabytesPerSecond, profile.busMegabytesPerSecond})
        require(rate >= 0 && rate <= 1e6, "rate");
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    static const Folder folder;
    const auto file = folder.write("chip.toml", textOf(data, size));
    takenOrRefused<gnomon::ProfileError>(file.string() + ":",
                                         [&] { checkProfile(gnomon::loadProfile(file)); });
    return 0;
}
