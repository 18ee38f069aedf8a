#include "matrix/judge.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Whether a pixel within @p reach of (x, y), diagonally too, is in the other class of truth.
bool nearBoundary(const Truth& truth, int x, int y, int reach) {
    const bool shadow = truth.shadow[std::size_t(y) * truth.width + x] == Shadow::InShadow;
    for (int v = std::max(0, y - reach); v <= std::min(truth.height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(truth.width - 1, x + reach); ++u)
            if ((truth.shadow[std::size_t(v) * truth.width + u] == Shadow::InShadow) != shadow) return true;
    }
    return false;
}

}  // namespace

Judgement judge(const Truth& truth, const std::vector<bool>& maskShadow, int maskDivisor, bool clamps) {
    Judgement out;
    out.pixels.assign(truth.shadow.size(), PixelVerdict::Right);
    out.tiedByTruth.assign(truth.shadow.size(), false);
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const std::size_t i = std::size_t(y) * truth.width + x;
            const bool countTied =
                truth.tie[i] == Tie::Count || (clamps && truth.tie[i] == Tie::CountIfClamped);
            // Dark whatever the mask says, so neither a tie of the count nor the mask decides anything.
            if (truth.facesAway[i] && truth.tie[i] != Tie::Truth) continue;
            if (countTied || truth.tie[i] == Tie::Truth) {
                ++(countTied ? out.tiedCount : out.tiedTruth);
                out.pixels[i] = PixelVerdict::Tied;
                out.tiedByTruth[i] = !countTied;
                continue;
            }
            if (maskShadow[i] == truth.blocked[i]) continue;
            const bool edge = nearBoundary(truth, x, y, maskDivisor);
            ++(edge ? out.edge : out.interior);
            out.pixels[i] = edge ? PixelVerdict::WrongEdge : PixelVerdict::WrongInterior;
        }
    }
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
