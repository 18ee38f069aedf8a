#include "matrix/lab.h"

#include <fmt/format.h>

#include <algorithm>

#include "gl/capability.h"
#include "matrix/causes.h"

namespace gnomon {
namespace {

struct FrameKey {
    int width = 0, height = 0, frame = 0;
    auto operator<=>(const FrameKey&) const = default;
};

/// FNV-1a, 64 bits.
class Digest {
  public:
    void add(std::uint8_t byte) { m_hash = (m_hash ^ byte) * 1099511628211ull; }
    std::string text() const { return fmt::format("{:016x}", m_hash); }

  private:
    std::uint64_t m_hash = 14695981039346656037ull;
};

std::string digestOf(const Rendered& rendered) {
    Digest digest;
    for (const bool shadow : rendered.maskShadow) digest.add(shadow);
    for (const std::uint8_t byte : rendered.image.data) digest.add(byte);
    return digest.text();
}

Image truthPicture(const Truth& truth) {
    return shadowPicture(truth, truth.blocked);
}

/// All that a result depends on besides the frame: the buffers, the passes with their states, and how volumes
/// are built.
std::string resultKey(const BufferFormat& f, const Plan& plan, const Axes& axes) {
    std::string key =
        fmt::format("{}.{}.{}.{}.{}.{} {}x{} {}x{} {} {} {}", f.red, f.green, f.blue, f.alpha, f.depth,
                    f.stencil, plan.maskWidth, plan.maskHeight, plan.textureWidth, plan.textureHeight,
                    plan.threshold, name(axes.silhouette), name(axes.count));
    for (const Pass& pass : plan.passes)
        key += fmt::format("|{} {} {} {}", pass.label, describeState(pass), int(pass.shading),
                           int(pass.lowResolution));
    return key;
}

}  // namespace

struct Lab::Impl {
    explicit Impl(Scene s) : scene(std::move(s)) {}

    Scene scene;
    std::map<Silhouette, std::vector<LitCaster>> lit{};
    std::map<Silhouette, std::unique_ptr<Tracer>>
        tracers{};  ///< count ties are about the sides that are drawn
    std::map<std::tuple<BufferFormat, int, int>, std::unique_ptr<Surface>> contexts{};

    // Of the frame that was asked for last.
    FrameKey key{};
    std::optional<FrameSurfaces> surfaces{};
    std::map<std::pair<Silhouette, Count>, FrameVolumes> volumes{};
    std::map<std::pair<int, Silhouette>, Truth> truths{};  ///< by bits of depth
    std::map<std::string, Cell> results{};
    std::map<BufferFormat, double> unshadowed{};
    std::optional<bool> eyeInside{};

    const Light& light() const { return scene.lights.front(); }

    void select(const FrameKey& k) {
        if (k == key) return;
        if (k.width != key.width || k.height != key.height) contexts.clear();
        key = k;
        surfaces.reset();
        volumes.clear();
        truths.clear();
        results.clear();
        unshadowed.clear();
        eyeInside.reset();
    }

    View view() const { return viewOf(scene.frames[std::size_t(key.frame)], key.width, key.height); }

    const std::vector<LitCaster>& litOf(Silhouette silhouette) {
        auto [at, isNew] = lit.try_emplace(silhouette);
        if (isNew) at->second = litCasters(scene, light().position, silhouette);
        return at->second;
    }

    bool eyeInVolumes() {
        if (!eyeInside) eyeInside = eyeInVolume(scene, litOf(Silhouette::Winding), light().position, view());
        return *eyeInside;
    }

    /// @p hasVolumes: the unshadowed frame has none
    const FrameVolumes& volumesOf(const Axes& axes) {
        static const FrameVolumes kNone;
        if (axes.store == Store::None) return kNone;
        const bool cap = axes.count == Count::ZpassCap && eyeInVolumes();
        // Away from all volumes a near cap changes nothing, and both counts share their volumes.
        const Count count = cap ? Count::ZpassCap : Count::Zpass;
        auto [at, isNew] = volumes.try_emplace({axes.silhouette, count});
        if (isNew) at->second = frameVolumes(scene, litOf(axes.silhouette), light().position, view(), cap);
        return at->second;
    }

    const FrameSurfaces& surfacesOf() {
        if (!surfaces) surfaces = frameSurfaces(scene, light(), view());
        return *surfaces;
    }

    const Truth& truthOf(int depthBits, Silhouette silhouette) {
        auto [at, isNew] = truths.try_emplace({depthBits, silhouette});
        if (isNew) {
            auto& tracer = tracers[silhouette];
            if (!tracer) tracer = std::make_unique<Tracer>(scene, light(), silhouette);
            at->second = tracer->trace(view(), depthTies(depthBits));
        }
        return at->second;
    }

    Surface& contextOf(const BufferFormat& format) {
        auto& context = contexts[{format, key.width, key.height}];
        if (!context) context = std::make_unique<Surface>(format, key.width, key.height);
        return *context;
    }

    double unshadowedMs(const Profile& profile, const BufferFormat& format) {
        auto [at, isNew] = unshadowed.try_emplace(format);
        if (isNew) {
            const Plan plan = planFrame({.store = Store::None}, {0, key.width, key.height}, profile);
            // Twice: the first compiles the driver's programs.
            for (int i = 0; i < 2; ++i)
                at->second = render(contextOf(format), profile, plan, surfacesOf(), {}).cpuMs;
        }
        return at->second;
    }

    Plan planOf(const Profile& profile, const Axes& axes) {
        return planFrame(axes, {int(volumesOf(axes).size()), key.width, key.height}, profile);
    }

    void draw(Cell& cell, const Profile& profile, const Axes& axes, const Plan& plan, Pictures* pictures,
              const std::function<void(Surface&, std::size_t)>& afterPass) {
        const BufferFormat format = bufferFormatOf(profile);
        cell.unshadowedMs = unshadowedMs(profile, format);
        Surface& surface = contextOf(format);
        AfterPass each;
        if (afterPass) each = [&](std::size_t pass) { afterPass(surface, pass); };
        const Rendered rendered = render(surface, profile, plan, surfacesOf(), volumesOf(axes), each);
        const Truth& truth = truthOf(format.depth, axes.silhouette);
        const Judgement judgement =
            judge(truth, rendered.maskShadow, axes.maskDivisor, axes.arithmetic != Arithmetic::Count);

        cell.passes = rendered.counts.passes;
        if (cell.passes != countPasses(plan))
            throw std::runtime_error("the passes counted at the capability layer are not those of the plan");
        cell.cpuMs = rendered.cpuMs;
        cell.tiedTruth = judgement.tiedTruth, cell.tiedCount = judgement.tiedCount;
        cell.wrongEdge = judgement.edge, cell.wrongInterior = judgement.interior;
        cell.verdict = judgement.interior ? Verdict::Wrong : judgement.edge ? Verdict::Edge : Verdict::Exact;
        cell.causes = causesOf(
            judgement, truth, axes, view(), surfacesOf(), volumesOf(axes), eyeInVolumes(), format.depth,
            axes.store == Store::Alpha ? format.alpha : std::min({format.red, format.green, format.blue}));
        surface.makeCurrent();
        cell.digest = digestOf(rendered);
        if (pictures)
            *pictures = {rendered.image, shadowPicture(truth, rendered.maskShadow), truthPicture(truth),
                         judgement};
    }
};

Lab::Lab(Scene scene) : m_impl(std::make_unique<Impl>(std::move(scene))) {}
Lab::~Lab() = default;

const Scene& Lab::scene() const {
    return m_impl->scene;
}

Plan Lab::plan(const Profile& profile, const Axes& axes, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    return m_impl->planOf(profile, axes);
}

std::vector<Lab::Candidate> Lab::path(const Profile& profile, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    std::vector<Candidate> tried;
    for (Axes axes : pathCandidates()) {
        if (axes.store == Store::Stencil && m_impl->eyeInVolumes()) axes.count = Count::ZpassCap;
        tried.push_back({axes, missing(profile, m_impl->planOf(profile, axes))});
        if (tried.back().missing.empty()) break;
    }
    return tried;
}

Cell Lab::run(const Profile& profile, const Axes& axes, int width, int height, int frame, Pictures* pictures,
              const std::function<void(Surface&, std::size_t)>& afterPass) {
    m_impl->select({width, height, frame});
    Cell cell;
    cell.profile = profile.id, cell.method = methodId(axes), cell.scene = m_impl->scene.id;
    cell.axes = axes;
    cell.width = width, cell.height = height, cell.frame = frame;
    cell.pixels = width * height;
    try {
        const Plan plan = m_impl->planOf(profile, axes);
        cell.missing = missing(profile, plan);
        if (!cell.missing.empty()) {
            cell.verdict = Verdict::Refused;
            cell.passes = countPasses(plan);
            return cell;
        }
        const std::string key = resultKey(bufferFormatOf(profile), plan, axes);
        const auto known = m_impl->results.find(key);
        if (known != m_impl->results.end() && !pictures && !afterPass) {
            Cell same = known->second;
            same.profile = profile.id;
            same.method = cell.method;
            same.axes = axes;
            return same;
        }
        m_impl->draw(cell, profile, axes, plan, pictures, afterPass);
        m_impl->results[key] = cell;
    } catch (const CapabilityViolation& violation) {
        cell.verdict = Verdict::Failed;
        cell.error = violation.what();
    } catch (const std::runtime_error& error) {
        cell.verdict = Verdict::Failed;
        cell.error = error.what();
    }
    return cell;
}

}  // namespace gnomon
