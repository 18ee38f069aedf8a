#include "needs/minimal_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "method/capacity.h"
#include "needs/finished_mask.h"

namespace gnomon {
namespace {

/// What a draw call costs, in pixels of a window: volumes with much the same window are drawn in one call.
constexpr double kDrawPixels = 16384;

/// Volumes on one ray up to which entries and exits are held against none.
constexpr int kMostCrossed = 6;

/// Volumes around a point up to which two ways to count are compared value by value. Beyond, a count that its
/// capacity holds goes on as it began.
constexpr int kMostCompared = 12;

bool hasVolumes(const Axes& axes) {
    return axes.store != Store::None && axes.store != Store::DepthMap && axes.count != Count::AtomicZp;
}

/// Whether the plan draws each volume by itself.
bool drawsOneByOne(const Axes& axes) {
    if (axes.arithmetic == Arithmetic::Parity) return axes.store == Store::Stencil;
    return axes.arithmetic != Arithmetic::Count;
}

double areaOf(const WindowRect& r) {
    return r.empty() ? 0 : double(r.width) * double(r.height);
}

std::string textOf(const WindowRect& r) {
    return fmt::format("{}x{} at {},{}", r.width, r.height, r.x, r.y);
}

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Volumes that share a window, so that one call draws them.
struct WindowGroup {
    WindowRect window{};
    std::vector<std::uint32_t> volumes{};
};

/// Puts each volume into the group in which its window grows least, or into one of its own where that saves
/// more pixels than a call costs.
std::vector<WindowGroup> grouped(const std::vector<WindowRect>& windows,
                                 const std::vector<std::uint32_t>& kept) {
    std::vector<std::uint32_t> order = kept;
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return areaOf(windows[a]) > areaOf(windows[b]); });
    std::vector<WindowGroup> groups;
    for (const std::uint32_t volume : order) {
        const WindowRect& own = windows[volume];
        double least = kDrawPixels;
        WindowGroup* best = nullptr;
        for (WindowGroup& group : groups) {
            const double grown = areaOf(around(group.window, own));
            const double more =
                grown - areaOf(own) + double(group.volumes.size()) * (grown - areaOf(group.window));
            if (more < least) least = more, best = &group;
        }
        if (!best) best = &groups.emplace_back();
        best->window = around(best->window, own);
        best->volumes.push_back(volume);
    }
    return groups;
}

class Planner {
  public:
    Planner(const Axes& axes, const FrameShape& frame, const Profile& profile, const FrameNeeds& needs,
            const MaskChannel& channel, const Effects& wanted)
        : m_axes(axes),
          m_full(frame),
          m_profile(profile),
          m_needs(needs),
          m_channel(channel),
          m_wanted(wanted) {
        out.axes = axes;
        m_shape = frame;
        if (!hasVolumes(axes) || frame.lights.empty()) return;
        const Plan plan = planFrame(axes, oneLight(1), profile);
        m_doubles = !plan.masks.front().alphaTest.enabled;
    }

    MinimalPlan build() {
        leaveOutLights();
        leaveOutAmbient();
        if (hasVolumes(m_axes) && !m_full.lights.empty()) {
            out.isFull = false;
            out.volumes.resize(m_full.lights.size());
            chooseCount();
            for (std::size_t light = 0; light < m_full.lights.size(); ++light) chooseVolumes(int(light));
            chooseLevels();
            finishMasks();
        }
        out.plan = planFrame(out.axes, m_shape, m_profile);
        return std::move(out);
    }

    bool mayLoseCounts() const {
        return hasVolumes(m_axes) &&
               std::any_of(m_needs.lights.begin(), m_needs.lights.end(),
                           [&](const LightNeeds& light) { return loss(light).has_value(); });
    }

  private:
    void note(Effect effect, int light, bool isDrawn, std::string fact) {
        out.notes.push_back({effect, light, isDrawn, m_wanted.has(effect) && isDrawn, std::move(fact)});
    }

    int lightOf(std::size_t index) const { return m_full.lights.size() > 1 ? int(index) : -1; }

    /// A frame of one light shows its mask over all its light; of several, each adds its own.
    void leaveOutLights() {
        if (m_full.lights.size() < 2) return;
        const bool isMasked = m_axes.store != Store::None;
        std::size_t drawn = m_full.lights.size();
        for (std::size_t i = 0; i < m_full.lights.size(); ++i) {
            const int brightest = m_needs.lights[i].brightest;
            const bool mayGo = brightest == 0 && !(isMasked && drawn == 1);
            if (mayGo && !m_wanted.has(Effect::Lights)) {
                m_shape.lights[i].isLeftOut = true;
                --drawn;
            }
            note(Effect::Lights, int(i), !m_shape.lights[i].isLeftOut,
                 brightest == 0 && !mayGo
                     ? "gives nothing to what is seen, but one light must be drawn"
                     : fmt::format("gives at most {} of 255 to what is seen", brightest));
        }
    }

    void leaveOutAmbient() {
        const bool inWindow = m_axes.store == Store::Screen || m_axes.store == Store::Counter ||
                              m_axes.store == Store::DepthMap || m_axes.apply == Apply::Texture;
        const bool isAdded = m_axes.store != Store::None &&
                             (m_full.lights.size() == 1
                                  ? m_axes.shade == Shade::Ambient
                                  : m_full.lights.size() > 1 && inWindow && m_axes.shade != Shade::Black);
        if (!isAdded) return;
        m_shape.withoutAmbient = m_needs.brightestAmbient == 0 && !m_wanted.has(Effect::Ambient);
        note(Effect::Ambient, -1, !m_shape.withoutAmbient,
             fmt::format("the brightest that is seen is {} of 255", m_needs.brightestAmbient));
    }

    static bool touchesNear(const LightNeeds& light, std::size_t volume) {
        return light.nearDistances[volume] <= 0;
    }

    /// How the full plan's mask may lose or keep what is to be left out.
    std::optional<std::string> loss(const LightNeeds& light) const {
        if (light.losesNothing) return std::nullopt;
        if (isTooDeep(m_axes, light.full)) return "volumes may nest deeper than the method holds";
        if (!cancels()) return "an entry and an exit may leave a residue in the mask";
        return std::nullopt;
    }

    bool cancels() const {
        if (m_axes.store != Store::Screen && m_axes.store != Store::Alpha) return true;
        if (!m_cancels) {
            Nesting all;
            for (const LightNeeds& light : m_needs.lights) all = deepest(all, light.full);
            const bool inTurn = drawsOneByOne(m_axes);
            m_cancels = facesCancel(m_axes, oneLight(0), m_profile, m_channel,
                                    {.around = std::min(inTurn ? all.levels - 1 : all.overlap, kMostCrossed),
                                     .crossed = std::min(all.fronts, kMostCrossed),
                                     .levels = inTurn ? all.levels : 0});
        }
        return *m_cancels;
    }

    bool isTooDeep(const Axes& axes, const Nesting& nesting) const {
        return nestingWarning(capacity(axes, m_profile, m_doubles), nesting).has_value();
    }

    /// From z-fail and its like to z-pass, with near caps where volumes touch the near rectangle.
    void chooseCount() {
        std::size_t touching = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (const LightNeeds& light : m_needs.lights) {
            for (std::size_t v = 0; v < light.nearDistances.size(); ++v) {
                if (!light.isDrawn[v]) continue;
                if (touchesNear(light, v))
                    ++touching;
                else
                    nearest = std::min(nearest, light.nearDistances[v]);
            }
        }
        const bool hasNone = !std::isfinite(nearest) && touching == 0;
        const std::string where =
            hasNone ? "there is no volume"
            : touching == 0
                ? fmt::format("the nearest volume is {:.3g} units from the near rectangle", nearest)
                : fmt::format("{} may touch the near rectangle", counted(touching, "volume"));
        if (m_axes.count == Count::Zpass) {
            note(Effect::NearCaps, -1, false, touching ? where + ", but the method has none" : where);
            return;
        }
        Axes simpler = m_axes;
        simpler.count = touching ? Count::ZpassCap : Count::Zpass;
        if (simpler.count == m_axes.count) return note(Effect::NearCaps, -1, true, where);
        const std::optional<std::string> obstacle = obstacleTo(simpler);
        if (m_wanted.has(Effect::NearCaps) || obstacle)
            return note(Effect::NearCaps, -1, true,
                        obstacle && !m_wanted.has(Effect::NearCaps) ? fmt::format("{}; {}", where, *obstacle)
                                                                    : where);
        out.axes = simpler;
        const bool wasZfail = m_axes.count == Count::Zfail;
        note(Effect::NearCaps, -1, touching > 0,
             touching
                 ? fmt::format("{}: z-pass with near caps instead of {}; no surface is nearer to the near "
                               "plane than {:.3g} units",
                               where, name(m_axes.count), m_needs.nearestSurface)
                 : fmt::format("{}{}", where, wasZfail ? ": z-pass instead of zfail" : ""));
    }

    /// Why the frame's masks can't be counted by @p simpler without any change.
    std::optional<std::string> obstacleTo(const Axes& simpler) const {
        const bool capped = simpler.count == Count::ZpassCap;
        if (capped && m_axes.count != Count::Zfail)
            return "caps at the near plane come out otherwise from " + name(m_axes.count);
        if (capped && m_axes.clip != Clip::Frustum) return "volumes are not cut at the near plane";
        if (capped && m_needs.nearestSurface <= 0) return "surfaces touch the near plane too";
        if (m_axes.offset != 0) return "volumes start behind their casters";
        if (m_axes.capFaces != CapFaces::Lit) return "volumes start at the casters' far sides";
        for (const LightNeeds& light : m_needs.lights) {
            if (!light.isClosed) return "the volumes are not closed";
            if (light.eyeIsOnFace) return "the eye is on a face of a volume";
            if (const auto lost = loss(light)) return lost;
            if (isTooDeep(simpler, light.fromEye)) return "volumes may nest deeper than z-pass holds";
        }
        const FrameShape one = oneLight(1);
        if (!missing(m_profile, planFrame(simpler, one, m_profile)).empty()) return "the chip can't z-pass";
        return unlike(m_axes, simpler);
    }

    /// Whether masks of up to some volumes end at other values by @p simpler than by @p full.
    std::optional<std::string> unlike(const Axes& full, const Axes& simpler) const {
        int most = 0;
        for (const LightNeeds& light : m_needs.lights) most = std::max(most, light.full.overlap);
        const auto at =
            firstDifference(full, simpler, oneLight(0), m_profile, m_channel, std::min(most, kMostCompared));
        if (!at) return std::nullopt;
        return fmt::format("{} around a point would give another value", counted(std::size_t(*at), "volume"));
    }

    FrameShape oneLight(int volumes) const {
        FrameShape one = m_full;
        one.lights.resize(1);
        one.lights[0].volumes = volumes;
        return one;
    }

    /// Why nothing is known of where single volumes matter.
    std::optional<std::string> noWindows(const LightNeeds& light, int holdingEye) const {
        if (m_axes.offset != 0) return "volumes start behind their casters";
        if (!light.isClosed) return "the volumes are not closed";
        if (light.eyeIsOnFace) return "the eye is on a face of a volume";
        if (const auto lost = loss(light)) return lost;
        bool touching = false;
        for (std::size_t v = 0; v < light.isDrawn.size(); ++v)
            touching = touching || (light.isDrawn[v] && touchesNear(light, v));
        if (touching && out.axes.clip != Clip::Frustum) return "volumes are not cut at the near plane";
        if (touching && out.axes.count == Count::PlusPlusZp) return "volumes are counted from the eye on";
        if (holdingEye != 0) return "volumes are counted from the eye on";
        return std::nullopt;
    }

    void chooseVolumes(int index) {
        const auto i = std::size_t(index);
        const LightNeeds& light = m_needs.lights[i];
        std::vector<std::uint32_t>& kept = out.volumes[i];
        std::vector<WindowRect> windows = light.windows;
        const WindowRect whole = wholeMask();
        const auto obstacle = noWindows(light, m_full.lights[i].holdingEye);
        std::size_t open = 0, drawn = 0;
        for (std::size_t v = 0; v < windows.size(); ++v) {
            if (!light.isDrawn[v]) continue;
            ++drawn;
            const bool isOpen = out.axes.count == Count::Zpass && touchesNear(light, v);
            open += isOpen;
            const bool isWanted = windows[v].empty() && m_wanted.has(Effect::Volumes);
            if (obstacle || isOpen || isWanted) windows[v] = whole;
            if (!windows[v].empty()) kept.push_back(std::uint32_t(v));
        }
        const std::size_t gone = drawn - kept.size();
        std::string fact =
            obstacle ? *obstacle : fmt::format("{} of {} hold no point that is seen", gone, drawn);
        if (open) fact += fmt::format("; {} open at the near plane", counted(open, "volume"));
        note(Effect::Volumes, lightOf(i), gone == 0, fact);

        const bool isWindowed =
            !obstacle && open == 0 && !m_wanted.has(Effect::Volumes) && !m_wanted.has(Effect::Window);
        chooseFarCaps(index, isWindowed ? light.seesBackgroundInWindows : light.seesBackground);
        LightShape& shape = m_shape.lights[i];
        shape.volumes = int(kept.size());
        if (m_wanted.has(Effect::Window))
            for (const std::uint32_t v : kept) windows[v] = whole;
        MaskWindow window;
        if (drawsOneByOne(out.axes)) {
            for (const std::uint32_t v : kept) window.volumes.push_back(windows[v]);
        } else {
            std::vector<std::uint32_t> inGroups;
            for (const WindowGroup& group : grouped(windows, kept)) {
                window.volumes.insert(window.volumes.end(), group.volumes.size(), group.window);
                inGroups.insert(inGroups.end(), group.volumes.begin(), group.volumes.end());
            }
            kept = std::move(inGroups);
        }
        for (const WindowRect& one : window.volumes) window.all = around(window.all, one);
        if (kept.empty() && m_wanted.has(Effect::Mask)) window.all = whole;
        const bool isWhole = std::all_of(window.volumes.begin(), window.volumes.end(),
                                         [&](const WindowRect& r) { return r == whole; });
        if (!(isWhole && window.all == whole)) shape.window = window;
        noteWindow(lightOf(i), window.all, whole, obstacle);
    }

    void noteWindow(int light, const WindowRect& all, const WindowRect& whole,
                    const std::optional<std::string>& obstacle) {
        if (all.empty()) return note(Effect::Mask, light, false, "no volume holds a point that is seen");
        note(Effect::Mask, light, true,
             all == whole && obstacle ? *obstacle : "shadows may fall into " + textOf(all));
        note(Effect::Window, light, all == whole,
             obstacle ? *obstacle
                      : fmt::format("volumes matter in {} of {}x{} pixels", textOf(all), whole.width,
                                    whole.height));
    }

    WindowRect wholeMask() const {
        return {0, 0, (m_full.width + m_axes.maskDivisor - 1) / m_axes.maskDivisor,
                (m_full.height + m_axes.maskDivisor - 1) / m_axes.maskDivisor};
    }

    /// Far caps lie at infinity: seen from the eye they are before nothing but the background.
    void chooseFarCaps(int index, bool seesBackground) {
        const bool fromInfinity = out.axes.count == Count::Zfail;
        const bool isCalledFor =
            fromInfinity || seesBackground || m_full.lights[std::size_t(index)].directional;
        m_shape.lights[std::size_t(index)].withoutFarCaps = !isCalledFor && !m_wanted.has(Effect::FarCaps);
        if (m_full.lights[std::size_t(index)].directional)
            return note(Effect::FarCaps, lightOf(std::size_t(index)), false,
                        "the volumes of a directional light meet at infinity");
        note(Effect::FarCaps, lightOf(std::size_t(index)), isCalledFor || m_wanted.has(Effect::FarCaps),
             fromInfinity     ? "z-fail counts them"
             : seesBackground ? "the background is seen where volumes matter"
                              : "no background is seen where volumes matter");
    }

    void chooseLevels() {
        if (m_axes.arithmetic != Arithmetic::Double) return;
        int bound = 0;
        bool isKnown = true;
        for (std::size_t i = 0; i < m_needs.lights.size(); ++i) {
            const LightNeeds& light = m_needs.lights[i];
            bound =
                std::max(bound, out.axes.count == Count::Zfail ? light.full.levels : light.fromEye.levels);
            isKnown = isKnown && !loss(light);
        }
        const std::string fact =
            fmt::format("at most {} of volumes nest", counted(std::size_t(bound), "level"));
        Axes fewer = out.axes;
        fewer.levels = std::max(1, bound);
        if (fewer.levels >= m_axes.levels) return note(Effect::Levels, -1, true, fact);
        const auto obstacle = unlike(out.axes, fewer);
        if (m_wanted.has(Effect::Levels) || !isKnown || obstacle)
            return note(Effect::Levels, -1, true,
                        obstacle ? fmt::format("{}, but {}", fact, *obstacle) : fact);
        note(Effect::Levels, -1, false,
             fmt::format("{}: {} instead of {}", fact, fewer.levels, m_axes.levels));
        out.axes = fewer;
    }

    /// Rectangles over the mask that a window saves something of, at least.
    double normalisations() const {
        switch (out.axes.arithmetic) {
            case Arithmetic::Double:
                return out.axes.levels + 1;
            case Arithmetic::Halve:
            case Arithmetic::Parity:
                return 1;
            case Arithmetic::Count:
                return m_doubles ? 2 : 1;
        }
        return 1;
    }

    /// What a lit pixel's mask ends as; where no clear makes that, the mask is drawn everywhere.
    void finishMasks() {
        if (m_axes.store == Store::Stencil) return;
        const auto finished = finishedMask(out.axes, oneLight(0), m_profile, m_channel);
        const WindowRect whole = wholeMask();
        for (LightShape& light : m_shape.lights) {
            if (!light.window) continue;
            // A second clear where the mask starts must be worth it.
            const double inside = areaOf(light.window->all), outside = areaOf(whole) - inside;
            if (finished && inside <= normalisations() * outside) {
                light.finished = finished->value;
                light.finishedIsNeutral =
                    m_full.lights.size() == 1 && finished->isNeutral && !m_wanted.has(Effect::Window);
            } else {
                light.window->all = whole;
            }
        }
        if (finished) return;
        for (EffectNote& one : out.notes) {
            if (one.effect != Effect::Window && one.effect != Effect::Mask) continue;
            one.isDrawn = true;
            one.fact += ", but no clear makes what a lit pixel ends as";
        }
    }

    const Axes& m_axes;
    const FrameShape& m_full;
    const Profile& m_profile;
    const FrameNeeds& m_needs;
    const MaskChannel& m_channel;
    const Effects& m_wanted;
    mutable std::optional<bool> m_cancels{};
    bool m_doubles = true;  ///< a count is doubled to 0 or 1, and not told apart by an alpha test
    FrameShape m_shape{};
    MinimalPlan out{};
};

}  // namespace

bool mayLoseCounts(const Axes& given, const FrameShape& frame, const Profile& profile,
                   const FrameNeeds& needs, const MaskChannel& channel) {
    const Axes axes = normalised(given);
    return Planner(axes, frame, profile, needs, channel, Effects::none()).mayLoseCounts();
}

MinimalPlan minimalPlan(const Axes& given, const FrameShape& frame, const Profile& profile,
                        const FrameNeeds& needs, const MaskChannel& channel, const Effects& wanted) {
    const Axes axes = normalised(given);
    return Planner(axes, frame, profile, needs, channel, wanted).build();
}

}  // namespace gnomon
