#include "predict/mask_prediction.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "predict/mask_bounds.h"
#include "predict/mask_run.h"

namespace gnomon {
namespace {

constexpr int kCounterValues = 1 << 16;

/// Ways in which a crossing may meet a pass.
enum Meeting { kNothing, kFrontPasses, kFrontFails, kBackPasses, kBackFails, kMeetings };

/// Sorted values without repetition.
using Values = std::vector<std::uint16_t>;

void makeSet(Values& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

struct MaskPrediction::Impl {
    explicit Impl(const MaskInputs& inputs)
        : in(inputs),
          plan(in.plan),
          tap(tapOf(plan, in.light)),
          run(runOf(plan, tap)),
          wraps(wrapsIn(plan, run)) {
        period = hasCodes() ? in.arithmetic.period() : 1;
        isBounded = tap.outside >= 0 || plan.passes[run.first].extent != Extent::Whole;
        leavesOut = std::find(in.planVolumes.begin(), in.planVolumes.end(), kLeftOut) != in.planVolumes.end();
        for (std::size_t i = run.first + 1; i < run.last; ++i) {
            const Pass& pass = plan.passes[i];
            const bool counts = pass.kind == PassKind::Volume || pass.kind == PassKind::Rectangle ||
                                pass.kind == PassKind::Clear;
            if (!counts || !writesMask(pass, run.place)) continue;
            if (i < run.start && pass.kind == PassKind::Volume && pass.drawn != Drawn::Blockers)
                throw std::logic_error("a mask begins with what another one leaves");
            isBounded = isBounded || pass.extent != Extent::Whole;
            if (pass.kind == PassKind::Volume && pass.volume != kAllVolumes) {
                ofVolume[pass.volume].push_back(i);
                drawsOneByOne = true;
            } else {
                general.push_back(i);
            }
            if (pass.kind != PassKind::Volume) continue;
            volumeExtent = volumeExtent.value_or(pass.extent) == pass.extent ? pass.extent : Extent::Whole;
            countsNearCaps = countsNearCaps || draws(pass, Piece::NearCap);
            const Meeting entry = meeting(pass, true, kBefore);
            if (draws(pass, Piece::Side) && entry != kNothing) entersBefore += direction(pass, entry);
        }
        if (isBounded)
            bounds = MaskBounds(plan, in.light, in.crossings);
        else
            outcomes.resize(in.crossings.signatures.size() * std::size_t(period * period));
        if (tap.outside >= 0) {
            undrawn.exact = codeOf(tap.outside);
            undrawn.values = {std::uint16_t(undrawn.exact)};
        }
    }

    static const MaskTap& tapOf(const Plan& plan, int light) {
        for (const MaskTap& tap : plan.masks)
            if (tap.light == light) return tap;
        throw std::logic_error("no mask of this light");
    }

    struct Outcome {
        bool isKnown = false;
        int exact = 0, unlimited = 0, nearCaps = 0;
        int leastUnlimited = 0, mostUnlimited = 0;
        bool isStuck = false;
        Values values{};
    };

    const Outcome& at(int x, int y) {
        if (isBounded && isUndrawn(x, y)) return undrawn;
        const std::uint32_t pixel = std::uint32_t(y * in.crossings.width + x);
        if (in.crossings.others.empty() || !in.crossings.others.contains(pixel))
            return of(in.crossings.exact[pixel], x, y);
        // All that any of the surfaces allows
        Outcome& all = mixed[pixel];
        if (all.isKnown) return all;
        all.isKnown = true;
        bool isFirst = true;
        in.crossings.each(pixel, [&](std::uint32_t signature) {
            const Outcome& one = of(signature, x, y);
            if (isFirst) {
                all = one;
            } else {
                all.leastUnlimited = std::min(all.leastUnlimited, one.leastUnlimited);
                all.mostUnlimited = std::max(all.mostUnlimited, one.mostUnlimited);
                all.isStuck = all.isStuck || one.isStuck;
                all.values.insert(all.values.end(), one.values.begin(), one.values.end());
            }
            isFirst = false;
        });
        makeSet(all.values);
        return all;
    }

    const Outcome& of(std::uint32_t signature, int x, int y) {
        // Masks stand in the window's lower left corner.
        const int windowY = y + plan.height - in.crossings.height;
        const int cell = (windowY % period) * period + x % period;
        const std::size_t index = std::size_t(signature) * std::size_t(period * period) + std::size_t(cell);
        Outcome& outcome = isBounded ? boundedOutcome(index, fromBelow(x, y)) : outcomes[index];
        if (!outcome.isKnown) {
            current = fromBelow(x, y);
            currentX = x % period, currentY = windowY % period;
            currentCell = cell;
            replay(in.crossings.signatures[signature], outcome);
        }
        return outcome;
    }

    /// Pixels of rectangles have rows from the bottom.
    glm::ivec2 fromBelow(int x, int y) const { return {x, in.crossings.height - 1 - y}; }

    /// Whether the plan draws no mask there.
    bool isUndrawn(int x, int y) const {
        if (tap.outside < 0) return false;
        const glm::ivec2 pixel = fromBelow(x, y);
        return !bounds.shadows(in.light).holds(pixel.x, pixel.y);
    }

    /// Whether a pass may change the current pixel; of one that bounds each volume by itself holds() knows.
    bool reaches(const Pass& pass) const {
        if (pass.extent == Extent::Whole) return true;
        const bool ofEach = pass.extent == Extent::Volumes;
        if (ofEach && pass.kind == PassKind::Volume) return true;
        const WindowRect& part =
            ofEach && pass.volume != kAllVolumes ? bounds.volume(pass.volume) : bounds.shadows(pass.light);
        return part.holds(current.x, current.y);
    }

    /// Whether passes of volumes draw that of the crossing at the current pixel.
    bool holds(Extent extent, const Crossing& c) const {
        if (!isBounded && !leavesOut) return true;
        const int index = in.planVolumes.empty() ? int(c.volume) : in.planVolumes[c.volume];
        if (index == kLeftOut) return false;
        return extent != Extent::Volumes || index < 0 || bounds.volume(index).holds(current.x, current.y);
    }

    /// Whether any pass may draw the crossing at the current pixel.
    bool mayBeDrawn(const Crossing& c) const {
        const Extent extent = volumeExtent.value_or(Extent::Whole);
        const bool isOutside =
            extent == Extent::Shadows && !bounds.shadows(in.light).holds(current.x, current.y);
        return !isOutside && holds(extent, c);
    }

    Outcome& boundedOutcome(std::size_t index, const glm::ivec2& pixel) {
        return boundedOutcomes[(std::uint64_t(index) << 32) | bounds.region(pixel)];
    }

    /// What a clear sets the mask to.
    int clearedBy(const Pass& pass) const {
        switch (run.place) {
            case MaskPlace::Stencil:
                return (pass.stencilIsBlockers ? in.holdingEye : pass.stencilValue) & 0xff;
            case MaskPlace::Alpha:
                return clearedTo(in.arithmetic, currentX, currentY, pass.colour.a);
            case MaskPlace::Counter:
                return 0;
            default:
                return clearedTo(in.arithmetic, currentX, currentY, pass.colour.r);
        }
    }

    /// Whether the light's count starts from what hides the eye, as the plan finds it by itself.
    bool startsAtEye() const { return plan.passes[run.start].stencilIsBlockers || tap.test.minusBlockers; }

    int reference() const {
        return (tap.test.reference - (tap.test.minusBlockers ? in.holdingEye : 0)) & 0xff;
    }

    bool draws(const Pass& pass, Piece piece) const {
        if (pass.drawn == Drawn::Blockers) return false;
        const bool bySilhouettes = pass.drawn == Drawn::Silhouettes;
        switch (piece) {
            case Piece::Side:
                return bySilhouettes || pass.parts.has(Part::Sides);
            case Piece::FarCap:
                return bySilhouettes || pass.parts.has(Part::FarCap);
            case Piece::LightCap:
                return pass.parts.has(Part::LightCap);
            case Piece::NearCap:
                return pass.parts.has(Part::NearCap);
            case Piece::NearLightCap:
                return bySilhouettes || pass.parts.has(Part::NearFaces);
            case Piece::NearSide:
                // Sides that the host leaves whole are cut at the near plane unless a depth clamp holds them.
                if (bySilhouettes) return true;
                return plan.clip == Clip::Frustum ? pass.parts.has(Part::NearFaces)
                                                  : pass.parts.has(Part::Sides) && pass.depthClamp;
        }
        return false;
    }

    static Meeting meeting(const Pass& pass, bool front, std::uint8_t where) {
        if (where == kAbsent) return kNothing;
        if ((pass.faces == Faces::Front && !front) || (pass.faces == Faces::Back && front)) return kNothing;
        const bool passes = passesDepth(pass, where == kBefore, where == kAt);
        return front ? (passes ? kFrontPasses : kFrontFails) : (passes ? kBackPasses : kBackFails);
    }

    int afterClear(const Pass& pass, int value) const {
        if (run.place != MaskPlace::Stencil) return clearedBy(pass);
        const int write = int(pass.stencil.writeMask & 0xffu);
        return (clearedBy(pass) & write) | (value & ~write);
    }

    int afterFragment(std::size_t index, Meeting meeting, int value) {
        const Pass& pass = plan.passes[index];
        const bool front = meeting == kFrontPasses || meeting == kFrontFails;
        const bool passes = meeting == kFrontPasses || meeting == kBackPasses;
        if (run.place == MaskPlace::Stencil) return stencilled(pass.stencil, front, passes, value);
        if (!passes) return value;
        if (run.place == MaskPlace::Counter) {
            const int step = front ? pass.frontCount : -pass.frontCount;
            return (value + step + kCounterValues) % kCounterValues;
        }
        auto& table = tables[{currentCell, opOf(index)}];
        if (table.empty()) table.resize(256, -1);
        int& code = table[std::size_t(value)];
        if (code < 0) {
            const auto made = blendedCode(in.arithmetic, currentX, currentY, pass, value);
            if (!made) throw std::logic_error("a mask is blended in a way that the predictor does not know");
            code = *made;
        }
        return code;
    }

    /// Passes that blend alike share a number.
    int opOf(std::size_t index) {
        auto [at, isNew] = opOfPass.try_emplace(index, 0);
        if (!isNew) return at->second;
        const Pass& pass = plan.passes[index];
        const auto same = std::find_if(ops.begin(), ops.end(), [&](const Pass* other) {
            return other->blend == pass.blend && other->colour == pass.colour &&
                   other->logicInvert == pass.logicInvert && other->write == pass.write;
        });
        at->second = int(same - ops.begin());
        if (same == ops.end()) ops.push_back(&pass);
        return at->second;
    }

    /// +1 for what counts up, doubles or inverts at an entry; -1 for the opposite.
    int direction(const Pass& pass, Meeting meeting) const {
        const bool front = meeting == kFrontPasses || meeting == kFrontFails;
        const bool passes = meeting == kFrontPasses || meeting == kBackPasses;
        if (run.place == MaskPlace::Stencil) {
            const StencilSide& side = front ? pass.stencil.front : pass.stencil.back;
            switch (passes ? side.onPass : side.onDepthFail) {
                case StencilOp::Incr:
                case StencilOp::IncrWrap:
                    return 1;
                case StencilOp::Decr:
                case StencilOp::DecrWrap:
                    return -1;
                case StencilOp::Invert:
                    return front ? 1 : -1;
                default:
                    return 0;
            }
        }
        if (!passes) return 0;
        if (run.place == MaskPlace::Counter) return front ? pass.frontCount : -pass.frontCount;
        const Blend& b = pass.blend;
        if (pass.logicInvert || (b.source == BlendFactor::OneMinusDstColor)) return front ? 1 : -1;
        if (b.source == BlendFactor::DstColor) return b.destination == BlendFactor::One ? 1 : -1;
        if (b.equation == BlendEquation::AddWrap)
            return (pass.write.alpha ? pass.colour.a : pass.colour.r) < 0.5f ? 1 : -1;
        return b.equation == BlendEquation::Add ? 1 : -1;
    }

    /// A volume's index among the plan's, -1 if no pass draws it.
    int planVolume(const Crossing& c) const {
        return in.planVolumes.empty() ? int(c.volume) : in.planVolumes[c.volume];
    }

    /// The crossings that a pass may draw.
    std::span<const Crossing> crossingsOf(const Pass& pass, const Signature& signature) const {
        if (pass.volume == kAllVolumes) return signature;
        auto first = signature.begin();
        while (first != signature.end() && planVolume(*first) != pass.volume) ++first;
        auto last = first;
        while (last != signature.end() && planVolume(*last) == pass.volume) ++last;
        return {first, last};
    }

    void replay(const Signature& signature, Outcome& outcome) {
        outcome.isKnown = true;
        const bool isSure =
            std::all_of(signature.begin(), signature.end(), [](const Crossing& c) { return c.isSure(); });
        const bool isStarted = reaches(plan.passes[run.start]), atEye = isStarted && startsAtEye();
        int exact = clearedBy(plan.passes[run.first]), net = atEye ? in.holdingEye : 0;
        if (!atEye && run.place == MaskPlace::Stencil)
            net = isStarted ? clearedBy(plan.passes[run.start]) - tap.test.reference : exact - reference();
        int least = net, most = net;
        Values values{std::uint16_t(exact)};

        // The passes that touch this ray, in their order.
        order.assign(general.begin(), general.end());
        bool misses = false;
        if (drawsOneByOne) {
            for (std::size_t i = 0; i < signature.size(); ++i) {
                const Crossing& c = signature[i];
                if (i > 0 && signature[i - 1].volume == c.volume) continue;
                const auto found = ofVolume.find(planVolume(c));
                if (found != ofVolume.end())
                    order.insert(order.end(), found->second.begin(), found->second.end());
                else
                    misses = misses || mustBeDrawn(signature, c.volume);
            }
            std::sort(order.begin(), order.end());
        }

        for (const std::size_t index : order) {
            const Pass& pass = plan.passes[index];
            if (!reaches(pass)) continue;
            if (pass.kind == PassKind::Clear) {
                exact = afterClear(pass, exact);
                for (auto& value : values) value = std::uint16_t(afterClear(pass, value));
                makeSet(values);
                continue;
            }
            if (pass.kind == PassKind::Rectangle) {
                exact = afterFragment(index, kFrontPasses, exact);
                for (auto& value : values) value = std::uint16_t(afterFragment(index, kFrontPasses, value));
                makeSet(values);
                continue;
            }
            const auto crossings = crossingsOf(pass, signature);
            for (const bool front : {true, false}) {
                for (const Crossing& c : crossings) {
                    if (c.front != front || !draws(pass, c.piece) || !holds(pass.extent, c)) continue;
                    const Meeting met = meeting(pass, front, c.exact);
                    if (met != kNothing) {
                        const int before = exact;
                        exact = afterFragment(index, met, exact);
                        outcome.isStuck = outcome.isStuck || (exact == before && direction(pass, met) != 0);
                        net += direction(pass, met);
                    }
                    if (isSure) continue;
                    const auto [down, up] = directions(pass, c);
                    least += down, most += up;
                    outcome.isStuck = spread(index, c, values) || outcome.isStuck;
                }
            }
            if (isSure) values = {std::uint16_t(exact)};
        }
        outcome.exact = exact;
        outcome.unlimited = net;
        outcome.leastUnlimited = isSure ? net : least;
        outcome.mostUnlimited = isSure ? net : most;
        if (!countsNearCaps)
            outcome.nearCaps = int(std::count_if(signature.begin(), signature.end(), [&](const Crossing& c) {
                return c.piece == Piece::NearCap && c.exact != kAbsent && mayBeDrawn(c);
            }));
        outcome.values = misses ? Values{} : std::move(values);
        // A face through the eye may be drawn in any pixel, or counted at the start, or neither.
        if (atEye && in.eyeOnFace) {
            outcome.values.resize(256);
            std::iota(outcome.values.begin(), outcome.values.end(), std::uint16_t(0));
        }
    }

    /// The least and the most that a crossing may add to a count without limits.
    std::pair<int, int> directions(const Pass& pass, const Crossing& c) const {
        if (c.possible == kAbsent) return {0, 0};
        int least = std::numeric_limits<int>::max(), most = std::numeric_limits<int>::min();
        const auto add = [&](std::uint8_t where) {
            const Meeting met = meeting(pass, c.front, where);
            const int step = met == kNothing ? 0 : direction(pass, met);
            least = std::min(least, step), most = std::max(most, step);
        };
        for (const std::uint8_t where : {kBefore, kAt, kBehind})
            if (c.possible & where) add(where);
        if (c.possible & kMaybeAbsent) add(kAbsent);
        return {least, most};
    }

    /// All values after one crossing, drawn in any way that is possible; whether one of them is stuck at its
    /// limit.
    bool spread(std::size_t index, const Crossing& c, Values& values) {
        const Pass& pass = plan.passes[index];
        bool ways[kMeetings] = {};
        for (const std::uint8_t where : {kBefore, kAt, kBehind})
            if (c.possible & where) ways[meeting(pass, c.front, where)] = true;
        if (c.possible == kAbsent || (c.possible & kMaybeAbsent)) ways[kNothing] = true;
        Values next;
        bool isStuck = false;
        for (int way = 0; way < kMeetings; ++way) {
            if (!ways[way]) continue;
            const bool changes = way != kNothing && direction(pass, Meeting(way)) != 0;
            for (const std::uint16_t value : values) {
                next.push_back(way == kNothing ? value
                                               : std::uint16_t(afterFragment(index, Meeting(way), value)));
                isStuck = isStuck || (changes && next.back() == value);
            }
        }
        makeSet(next);
        values.swap(next);
        return isStuck;
    }

    /// Whether the volume is there beyond doubt, and the plan's to draw.
    bool mustBeDrawn(const Signature& signature, std::uint32_t volume) const {
        if (!in.planVolumes.empty() && in.planVolumes[volume] == kLeftOut) return false;
        return std::any_of(signature.begin(), signature.end(), [&](const Crossing& c) {
            // What lies before the near plane alone is left out where no pass draws such pieces.
            const bool isBeyond = c.piece == Piece::Side || c.piece == Piece::FarCap;
            return c.volume == volume && isBeyond && !(c.possible & kMaybeAbsent);
        });
    }

    MaskPrediction::Doubt doubt(int x, int y) {
        if (isUndrawn(x, y)) return Doubt::None;
        current = fromBelow(x, y);
        const auto pixel = std::uint32_t(y * in.crossings.width + x);
        Doubt doubt = in.crossings.others.contains(pixel) ? Doubt::Others : Doubt::None;
        for (const Crossing& c : in.crossings.signatures[in.crossings.exact[pixel]]) {
            if (c.isSure() || !mayBeDrawn(c)) continue;
            doubt = c.own && doubt != Doubt::Others ? Doubt::Own : Doubt::Others;
        }
        return doubt;
    }

    bool hasCodes() const { return run.place == MaskPlace::Colour || run.place == MaskPlace::Alpha; }
    int codeOf(int shown) const { return hasCodes() ? truncated(shown, in.arithmetic.bits()) : shown; }

    const MaskInputs in;
    const Plan& plan;
    const MaskTap& tap;
    const MaskRun run;
    const bool wraps;
    int period = 1;

    std::vector<std::size_t> general{};                  ///< passes that touch all rays
    std::map<int, std::vector<std::size_t>> ofVolume{};  ///< those of one volume
    bool drawsOneByOne = false, countsNearCaps = false;
    bool leavesOut = false;                ///< some volumes are kLeftOut
    bool isBounded = false;                ///< some passes don't reach all pixels
    std::optional<Extent> volumeExtent{};  ///< of all volume passes; Whole where they differ
    MaskBounds bounds{};                   ///< where passes are bounded
    int entersBefore = 0;                  ///< what entries before the surface add, in all passes

    glm::ivec2 current{0};  ///< the pixel that is predicted, rows from the bottom
    int currentX = 0, currentY = 0, currentCell = 0;
    std::map<std::pair<int, int>, std::vector<int>> tables{};  ///< by cell and operation: code after code
    std::map<std::size_t, int> opOfPass{};
    std::vector<const Pass*> ops{};
    std::vector<std::size_t> order{};

    std::vector<Outcome> outcomes{};  ///< by signature and cell
    /// The same where passes are bounded, by region too.
    std::unordered_map<std::uint64_t, Outcome> boundedOutcomes{};
    Outcome undrawn{};  ///< where the plan draws no mask
    std::unordered_map<std::uint32_t, Outcome> mixed{};
};

MaskPrediction::MaskPrediction(const MaskInputs& in) : m_impl(std::make_unique<Impl>(in)) {}
MaskPrediction::~MaskPrediction() = default;
MaskPrediction::MaskPrediction(MaskPrediction&&) noexcept = default;

int MaskPrediction::width() const {
    return m_impl->in.crossings.width;
}
int MaskPrediction::height() const {
    return m_impl->in.crossings.height;
}
int MaskPrediction::value(int x, int y) const {
    return m_impl->at(x, y).exact;
}
std::span<const std::uint16_t> MaskPrediction::values(int x, int y) const {
    return m_impl->at(x, y).values;
}
bool MaskPrediction::allows(int x, int y, int value) const {
    const auto all = values(x, y);
    return std::binary_search(all.begin(), all.end(), std::uint16_t(value));
}
bool MaskPrediction::isShadowShown(double value) const {
    return gnomon::isShadow(m_impl->plan, m_impl->tap, value, m_impl->reference());
}
double MaskPrediction::shown(int value) const {
    return m_impl->hasCodes() ? 255.0 * value / largestCode(m_impl->in.arithmetic.bits()) : value;
}
bool MaskPrediction::isShownAs(int x, int y, int value, int shown) const {
    if (m_impl->isUndrawn(x, y)) return shown == m_impl->tap.outside;
    const MaskChannel& channel = m_impl->in.arithmetic;
    const bool redrawn = m_impl->hasCodes() && m_impl->tap.place == MaskPlace::Texture && !channel.openGl;
    if (!redrawn) return codeOf(shown) == value;
    // As a texture it goes through the chip's store once more.
    const int again = clearedTo(channel, x, y, float(replicated(value, channel.bits())) / 255);
    return codeOf(shown) == again;
}
int MaskPrediction::codeOf(int shown) const {
    return m_impl->codeOf(shown);
}
int MaskPrediction::unlimitedCount(int x, int y) const {
    return m_impl->at(x, y).unlimited;
}
std::pair<int, int> MaskPrediction::unlimitedCounts(int x, int y) const {
    const auto& outcome = m_impl->at(x, y);
    return {outcome.leastUnlimited, outcome.mostUnlimited};
}
bool MaskPrediction::countsFromEye() const {
    return m_impl->entersBefore != 0;
}
bool MaskPrediction::startsAtEye() const {
    return m_impl->startsAtEye();
}
bool MaskPrediction::wraps() const {
    return m_impl->wraps;
}
bool MaskPrediction::isStencil() const {
    return m_impl->run.place == MaskPlace::Stencil;
}
bool MaskPrediction::hasCodes() const {
    return m_impl->hasCodes();
}
int MaskPrediction::uncountedNearCaps(int x, int y) const {
    return m_impl->at(x, y).nearCaps;
}

bool MaskPrediction::isStuck(int x, int y) const {
    return m_impl->at(x, y).isStuck;
}

MaskPrediction::Doubt MaskPrediction::doubt(int x, int y) const {
    return m_impl->doubt(x, y);
}

}  // namespace gnomon
