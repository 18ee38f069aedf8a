#include "matrix/judge.h"

#include <algorithm>
#include <optional>

#include "matrix/boundary.h"

namespace gnomon {
Judgement judge(const Truth& truth, const std::vector<bool>& maskShadow, int maskDivisor, bool clamps) {
    Judgement out;
    out.pixels.assign(truth.shadow.size(), PixelVerdict::Right);
    out.tiedByTruth.assign(truth.shadow.size(), false);
    std::optional<Boundary> boundary;  // most masks have no wrong pixel
    const auto judgePixel = [&](std::size_t i) {
        // Dark whatever the mask says, so neither a tie of the count nor the mask decides anything.
        if (truth.facesAway[i] && truth.tie[i] != Tie::Truth) return;
        const bool countTied = truth.tie[i] == Tie::Count || (clamps && truth.tie[i] == Tie::CountIfClamped);
        if (countTied || truth.tie[i] == Tie::Truth) {
            ++(countTied ? out.tiedCount : out.tiedTruth);
            out.pixels[i] = PixelVerdict::Tied;
            out.tiedByTruth[i] = !countTied;
            return;
        }
        if (maskShadow[i] == truth.blocked[i]) return;
        if (!boundary) boundary.emplace(truth, maskDivisor);
        const bool edge = boundary->isNear(int(i % truth.width), int(i / truth.width));
        ++(edge ? out.edge : out.interior);
        out.pixels[i] = edge ? PixelVerdict::WrongEdge : PixelVerdict::WrongInterior;
    };
    // Nearly all pixels are right and not tied.
    auto mask = maskShadow.begin(), blocked = truth.blocked.begin();
    for (std::size_t i = 0; i < out.pixels.size(); ++i, ++mask, ++blocked)
        if (*mask != *blocked || truth.tie[i] != Tie::None) judgePixel(i);
    return out;
}

Judgement combined(const std::vector<Judgement>& lights) {
    if (lights.size() == 1) return lights.front();
    Judgement out;
    out.pixels.assign(lights.front().pixels.size(), PixelVerdict::Right);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        for (const Judgement& light : lights) out.pixels[i] = std::max(out.pixels[i], light.pixels[i]);
        out.edge += out.pixels[i] == PixelVerdict::WrongEdge;
        out.interior += out.pixels[i] == PixelVerdict::WrongInterior;
        if (out.pixels[i] != PixelVerdict::Tied) continue;
        const bool byTruth = std::any_of(lights.begin(), lights.end(),
                                         [&](const Judgement& light) { return light.tiedByTruth[i]; });
        ++(byTruth ? out.tiedTruth : out.tiedCount);
    }
    return out;
}

Image shadowPicture(const Truth& truth, const std::vector<bool>& maskShadow) {
    Image picture{truth.width, truth.height, 1, {}};
    picture.data.resize(truth.shadow.size());
    for (std::size_t i = 0; i < picture.data.size(); ++i)
        picture.data[i] = maskShadow[i] || truth.facesAway[i] ? 0 : 255;
    return picture;
}

}  // namespace gnomon
