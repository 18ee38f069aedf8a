#include "predict/mask_prediction.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr int kCounterValues = 1 << 16;

/// The passes that make one mask.
struct Run {
    std::size_t first = 0, last = 0;    ///< of the plan's passes
    MaskPlace place = MaskPlace::None;  ///< Stencil, Counter, Colour or Alpha
};

bool writesMask(const Pass& pass, MaskPlace place) {
    switch (place) {
        case MaskPlace::Stencil:
            return pass.kind == PassKind::Clear ? pass.clearsStencil : pass.stencil.enabled;
        case MaskPlace::Alpha:
            return pass.write.alpha;
        default:
            return pass.write.red;
    }
}

Run runOf(const Plan& plan, const MaskTap& tap) {
    Run run{.last = tap.after, .place = tap.place};
    if (tap.place == MaskPlace::Texture) {
        // It is finished where it is copied.
        std::size_t copy = tap.after;
        while (copy > 0 &&
               (plan.passes[copy - 1].kind != PassKind::Copy || plan.passes[copy - 1].frameTexture))
            --copy;
        run.last = copy == 0 ? 0 : copy - 1;
        run.place =
            plan.passes[run.last].texture == MaskTexture::Alpha ? MaskPlace::Alpha : MaskPlace::Colour;
    }
    run.first = run.last;
    const auto starts = [&](const Pass& pass) {
        return pass.kind == PassKind::Clear && writesMask(pass, run.place) &&
               (run.place != MaskPlace::Stencil || (pass.stencil.writeMask & 0xffu) == 0xffu);
    };
    while (run.first > 0 && !starts(plan.passes[run.first - 1])) --run.first;
    if (run.first > 0) --run.first;
    return run;
}

bool wrapsUp(const StencilSide& side) {
    return side.onPass == StencilOp::IncrWrap || side.onDepthFail == StencilOp::IncrWrap;
}

/// Whether the passes count up and down in steps that wrap.
bool wrapsIn(const Plan& plan, const Run& run) {
    const auto at = [&](std::size_t pass) { return plan.passes.begin() + std::ptrdiff_t(pass); };
    return std::any_of(at(run.first), at(run.last), [](const Pass& pass) {
        return pass.kind == PassKind::Volume &&
               (wrapsUp(pass.stencil.front) || wrapsUp(pass.stencil.back) ||
                pass.program == Program::CountFaces ||
                (pass.blend.enabled && pass.blend.equation == BlendEquation::AddWrap));
    });
}

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
        outcomes.resize(in.crossings.signatures.size() * std::size_t(period * period));
        for (std::size_t i = run.first + 1; i < run.last; ++i) {
            const Pass& pass = plan.passes[i];
            const bool counts = pass.kind == PassKind::Volume || pass.kind == PassKind::Rectangle ||
                                pass.kind == PassKind::Clear;
            if (!counts || !writesMask(pass, run.place)) continue;
            if (pass.kind == PassKind::Volume && pass.volume != kAllVolumes) {
                ofVolume[pass.volume].push_back(i);
                drawsOneByOne = true;
            } else {
                general.push_back(i);
            }
            if (pass.kind != PassKind::Volume) continue;
            countsNearCaps = countsNearCaps || draws(pass, Piece::NearCap);
            const Meeting entry = meeting(pass, true, kBefore);
            if (draws(pass, Piece::Side) && entry != kNothing) entersBefore += direction(pass, entry);
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
        Outcome& outcome =
            outcomes[std::size_t(signature) * std::size_t(period * period) + std::size_t(cell)];
        if (!outcome.isKnown) {
            currentX = x % period, currentY = windowY % period;
            currentCell = cell;
            replay(in.crossings.signatures[signature], outcome);
        }
        return outcome;
    }

    int start() const {
        const Pass& pass = plan.passes[run.first];
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
    bool startsAtEye() const { return plan.passes[run.first].stencilIsBlockers || tap.test.minusBlockers; }

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
        if (run.place != MaskPlace::Stencil) return start();
        const int write = int(pass.stencil.writeMask & 0xffu);
        return (pass.stencilValue & write) | (value & ~write);
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
        int exact = start(), net = startsAtEye() ? in.holdingEye : 0;
        if (!startsAtEye() && run.place == MaskPlace::Stencil) net = exact - tap.test.reference;
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
                    if (c.front != front || !draws(pass, c.piece)) continue;
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
            outcome.nearCaps = int(std::count_if(signature.begin(), signature.end(), [](const Crossing& c) {
                return c.piece == Piece::NearCap && c.exact != kAbsent;
            }));
        outcome.values = misses ? Values{} : std::move(values);
        // A face through the eye may be drawn in any pixel, or counted at the start, or neither.
        if (startsAtEye() && in.eyeOnFace) {
            outcome.values.resize(256);
            std::iota(outcome.values.begin(), outcome.values.end(), std::uint16_t(0));
        }
    }

    /// The least and the most that a crossing may add to a count without limits.
    std::pair<int, int> directions(const Pass& pass, const Crossing& c) const {
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
        if (c.possible & kMaybeAbsent) ways[kNothing] = true;
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

    /// Whether the volume is there beyond doubt.
    static bool mustBeDrawn(const Signature& signature, std::uint32_t volume) {
        return std::any_of(signature.begin(), signature.end(), [&](const Crossing& c) {
            // What lies before the near plane alone is left out where no pass draws such pieces.
            const bool isBeyond = c.piece == Piece::Side || c.piece == Piece::FarCap;
            return c.volume == volume && isBeyond && !(c.possible & kMaybeAbsent);
        });
    }

    bool hasCodes() const { return run.place == MaskPlace::Colour || run.place == MaskPlace::Alpha; }

    const MaskInputs in;
    const Plan& plan;
    const MaskTap& tap;
    const Run run;
    const bool wraps;
    int period = 1;

    std::vector<std::size_t> general{};                  ///< passes that touch all rays
    std::map<int, std::vector<std::size_t>> ofVolume{};  ///< those of one volume
    bool drawsOneByOne = false, countsNearCaps = false;
    int entersBefore = 0;  ///< what entries before the surface add, in all passes

    int currentX = 0, currentY = 0, currentCell = 0;
    std::map<std::pair<int, int>, std::vector<int>> tables{};  ///< by cell and operation: code after code
    std::map<std::size_t, int> opOfPass{};
    std::vector<const Pass*> ops{};
    std::vector<std::size_t> order{};

    std::vector<Outcome> outcomes{};  ///< by signature and cell
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
    const MaskChannel& channel = m_impl->in.arithmetic;
    const bool redrawn = m_impl->hasCodes() && m_impl->tap.place == MaskPlace::Texture && !channel.openGl;
    if (!redrawn) return codeOf(shown) == value;
    // As a texture it goes through the chip's store once more.
    const int again = clearedTo(channel, x, y, float(replicated(value, channel.bits())) / 255);
    return codeOf(shown) == again;
}
int MaskPrediction::codeOf(int shown) const {
    return m_impl->hasCodes() ? truncated(shown, m_impl->in.arithmetic.bits()) : shown;
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
    const Crossings& all = m_impl->in.crossings;
    const auto pixel = std::uint32_t(y * all.width + x);
    Doubt doubt = all.others.contains(pixel) ? Doubt::Others : Doubt::None;
    for (const Crossing& c : all.signatures[all.exact[pixel]]) {
        if (c.isSure()) continue;
        doubt = c.own && doubt != Doubt::Others ? Doubt::Own : Doubt::Others;
    }
    return doubt;
}

}  // namespace gnomon
