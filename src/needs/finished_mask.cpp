#include "needs/finished_mask.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "predict/mask_prediction.h"

namespace gnomon {
namespace {

constexpr int kSide = 4;  ///< pixels: all dither matrices repeat within them

std::vector<int> channelsOf(const Axes& axes) {
    if (axes.store == Store::Screen) return {0, 1, 2};
    if (axes.store == Store::Alpha) return {3};
    return {0};
}

MaskChannel withChannel(MaskChannel mask, int channel) {
    mask.channel = channel;
    return mask;
}

/// How a volume lies on a ray.
struct Lies {
    enum Where { Around, Before, Behind } where = Around;
    int times = 1;  ///< that the ray enters and leaves it: it may be folded
};

/// A mask of some pixels whose rays meet such volumes.
Crossings crossingsOf(const std::vector<Lies>& volumes) {
    Crossings all;
    all.width = all.height = kSide;
    Signature signature;
    for (std::uint32_t v = 0; v < volumes.size(); ++v) {
        const std::uint8_t front = volumes[v].where == Lies::Behind ? kBehind : kBefore;
        const std::uint8_t back = volumes[v].where == Lies::Before ? kBefore : kBehind;
        for (int i = 0; i < volumes[v].times; ++i) {
            signature.push_back({.volume = v, .front = true, .exact = front, .possible = front});
            signature.push_back({.volume = v, .exact = back, .possible = back});
        }
    }
    std::sort(signature.begin(), signature.end());
    all.signatures.push_back(std::move(signature));
    all.exact.resize(std::size_t(kSide) * kSide);
    return all;
}

/// The finished mask, by pixel.
std::vector<int> finishedCodes(const Axes& axes, FrameShape one, const Profile& profile,
                               const MaskChannel& channel, const std::vector<Lies>& volumes) {
    one.width = one.height = kSide * axes.maskDivisor;
    one.lights.front().volumes = int(volumes.size());
    const Plan plan = planFrame(axes, one, profile);
    const Crossings crossings = crossingsOf(volumes);
    std::vector<int> indices(volumes.size());
    std::iota(indices.begin(), indices.end(), 0);
    const MaskPrediction prediction(
        {.plan = plan, .crossings = crossings, .arithmetic = channel, .planVolumes = indices});
    std::vector<int> codes;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) codes.push_back(prediction.value(x, y));
    return codes;
}

/// Whether a clear to @p value makes @p codes.
bool clearsTo(const MaskChannel& channel, float value, const std::vector<int>& codes) {
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            if (clearedTo(channel, x, y, value) != codes[std::size_t(y * kSide + x)]) return false;
    return true;
}

/// Whether a fragment of any colour, or over any code, comes out as without the mask, whose value is @p value
/// and whose code is @p code.
bool isNeutral(const Axes& axes, const MaskChannel& channel, float value, int code) {
    if (axes.store == Store::Screen && axes.apply == Apply::Blend) {
        Pass masked, plain;
        masked.blend = {.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::Zero};
        for (int source = 0; source < 256; ++source) {
            masked.colour = plain.colour = glm::vec4(float(source) / 255);
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x)
                    if (blendedCode(channel, x, y, masked, code) != blendedCode(channel, x, y, plain, code))
                        return false;
        }
        return true;
    }
    // Over the scene goes the mask's texture, or the alpha that stands in the buffer.
    if (value != 1) return false;
    if (axes.apply == Apply::Blend) return channel.openGl;
    Pass over;
    over.blend = {.enabled = true, .source = BlendFactor::Zero, .destination = BlendFactor::SrcColor};
    over.colour = glm::vec4(1);
    for (int held = 0; held < 1 << channel.bits(); ++held)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                if (blendedCode(channel, x, y, over, held) != held) return false;
    return true;
}

}  // namespace

std::optional<FinishedMask> finishedMask(const Axes& axes, const FrameShape& one, const Profile& profile,
                                         const MaskChannel& mask) {
    if (axes.store == Store::Counter) return FinishedMask{.value = 0};
    std::vector<std::pair<MaskChannel, std::vector<int>>> codes;
    for (const int c : channelsOf(axes)) {
        const MaskChannel channel = withChannel(mask, c);
        if (channel.bits() == 0) return std::nullopt;
        codes.emplace_back(channel, finishedCodes(axes, one, profile, channel, {}));
    }
    for (int value = 255; value >= 0; --value) {
        const float share = float(value) / 255;
        if (!std::all_of(codes.begin(), codes.end(),
                         [&](const auto& each) { return clearsTo(each.first, share, each.second); }))
            continue;
        FinishedMask found{.value = share, .isNeutral = true};
        for (const int c : {0, 1, 2}) {
            const auto& held = codes[std::min(codes.size() - 1, std::size_t(c))].second.front();
            const bool is = std::all_of(codes.begin(), codes.end(), [&](const auto& each) {
                return std::all_of(each.second.begin(), each.second.end(),
                                   [&](int code) { return code == each.second.front(); });
            });
            found.isNeutral = found.isNeutral && is && isNeutral(axes, withChannel(mask, c), share, held);
        }
        return found;
    }
    return std::nullopt;
}

std::optional<int> firstDifference(const Axes& a, const Axes& b, const FrameShape& one,
                                   const Profile& profile, const MaskChannel& mask, int most) {
    for (const int c : channelsOf(a)) {
        const MaskChannel channel = withChannel(mask, c);
        for (int volumes = 0; volumes <= most; ++volumes)
            if (const std::vector<Lies> around(std::size_t(volumes), Lies{});
                finishedCodes(a, one, profile, channel, around) !=
                finishedCodes(b, one, profile, channel, around))
                return volumes;
    }
    return std::nullopt;
}

bool facesCancel(const Axes& axes, const FrameShape& one, const Profile& profile, const MaskChannel& mask,
                 const MostCrossed& most) {
    for (const int c : channelsOf(axes)) {
        const MaskChannel channel = withChannel(mask, c);
        for (int around = 0; around <= most.around; ++around) {
            const std::vector<Lies> alone(std::size_t(around), Lies{});
            const std::vector<int> codes = finishedCodes(axes, one, profile, channel, alone);
            const auto cancel = [&](const Lies& how, int crossed) {
                // Drawn before and after the others.
                for (const bool first : {true, false}) {
                    std::vector<Lies> all = alone;
                    all.insert(first ? all.begin() : all.end(), std::size_t(crossed), how);
                    if (finishedCodes(axes, one, profile, channel, all) != codes) return false;
                }
                return true;
            };
            for (const Lies::Where where : {Lies::Before, Lies::Behind}) {
                for (int crossed = 1; crossed <= most.crossed; ++crossed)
                    if (!cancel({where}, crossed)) return false;
                for (int times = 2; around + times <= most.levels; ++times)
                    if (!cancel({where, times}, 1)) return false;
            }
        }
    }
    return true;
}

}  // namespace gnomon
