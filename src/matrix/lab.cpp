#include "matrix/lab.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gl/blend_program.h"
#include "gl/capability.h"
#include "gl/stopwatch.h"
#include "matrix/choice.h"
#include "matrix/digest.h"
#include "matrix/drawing.h"
#include "matrix/frame_scene.h"
#include "matrix/minimal_planner.h"
#include "matrix/result_key.h"
#include "method/capacity.h"
#include "method/shader_volumes.h"
#include "volume/blockers.h"
#include "volume/nesting.h"
#include "volume/silhouette_finder.h"

namespace gnomon {
namespace {

Image truthPicture(const Truth& truth) {
    return shadowPicture(truth, truth.blocked);
}

/// The share of the lights that arrive at each pixel.
Image averageOf(const std::vector<Image>& pictures) {
    Image out = pictures.front();
    for (std::size_t i = 0; i < out.data.size(); ++i) {
        std::size_t sum = 0;
        for (const Image& picture : pictures) sum += picture.data[i];
        out.data[i] = std::uint8_t(sum / pictures.size());
    }
    return out;
}

}  // namespace

struct Lab::Impl : FrameScene {
    explicit Impl(Scene s) : FrameScene(std::move(s)) {}

    FidelityChoice fidelity{};
    Device device = defaultDevice();
    std::optional<Effects> effects{};
    std::function<void(const std::string&)> stageListener{};
    std::function<void(const Cell&, const Pictures&)> drawnListener{};
    MinimalPlanner planner{*this};
    std::map<std::tuple<BufferFormat, ChipArithmetic, int, int>, std::unique_ptr<Surface>> contexts{};
    std::map<std::pair<Silhouette, CapFaces>, std::optional<std::string>> refusals{};

    // Of the frame that was asked for last.
    std::map<std::string, Cell> results{};
    std::map<std::string, std::vector<std::int64_t>> passed{};  ///< fragments by pass; keyed as results are
    std::map<std::pair<BufferFormat, ChipArithmetic>, double> unshadowed{};

    void select(const Key& frame) {
        const Key last = key();
        if (!FrameScene::select(frame)) return;
        if (frame.width != last.width || frame.height != last.height) contexts.clear();
        results.clear(), passed.clear(), unshadowed.clear();
        planner.select();
    }

    /// Sums that wrap are emulated for plans that have them, so that all others are OpenGL's alone.
    Surface& contextOf(const Profile& profile, const Plan& plan, const FidelityChoice& choice) {
        const BufferFormat format = bufferFormatOf(profile);
        ChipArithmetic chip = arithmeticOf(profile, choice);
        chip.wraps = chip.wraps && std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) {
                         return pass.blend.enabled && pass.blend.equation == BlendEquation::AddWrap;
                     });
        chip.everywhere = emulatesEverywhere();
        auto& context = contexts[{format, chip, key().width, key().height}];
        if (!context) context = std::make_unique<Surface>(format, key().width, key().height, chip, device);
        return *context;
    }

    void enter(const std::string& stage) const {
        if (stageListener) stageListener(stage);
    }

    double unshadowedMs(const Profile& profile) {
        auto [at, isNew] = unshadowed.try_emplace({bufferFormatOf(profile), arithmeticOf(profile, fidelity)});
        if (isNew) {
            enter("the frame without shadows");
            const Axes none{.store = Store::None};
            const Drawing drawing{.axes = none, .plan = planOf(profile, none)};
            const LightFrames frames = lightFrames(*this, profile, drawing);
            // Twice: the first compiles the driver's programs.
            for (int i = 0; i < 2; ++i)
                at->second = render(contextOf(profile, drawing.plan, fidelity), profile, drawing.plan,
                                    surfacesOf(), frames)
                                 .cpuMs;
        }
        return at->second;
    }

    Drawing drawingOf(const Profile& profile, const Axes& axes) {
        if (!effects || *effects == Effects::all()) return {.axes = axes, .plan = planOf(profile, axes)};
        return gnomon::drawingOf(minimalOf(profile, axes));
    }

    MinimalPlan minimalOf(const Profile& profile, const Axes& axes) {
        return planner.plan(profile, axes, fidelity, effects.value_or(Effects::none()));
    }

    FrameCost costOf(const Profile& profile, const Drawing& drawing, double hostMs) {
        const std::vector<DrawnAmount> drawn = amountsOf(*this, profile, drawing);
        std::vector<std::int64_t>& samples = passed[keyOf(profile, drawing)];
        if (samples.empty()) samples = drawOnce(profile, drawing, {.countsSamples = true}).passSamples;
        return frameCost(drawing.plan, profile, drawn, samples, hostMs);
    }

    /// The same for drawings that show the same.
    std::string keyOf(const Profile& profile, const Drawing& drawing) {
        return (emulatesEverywhere() ? "everywhere " : "") +
               resultKey(bufferFormatOf(profile), arithmeticOf(profile, fidelity), drawing.plan, drawing.axes,
                         volumeKeys(profile, drawing.axes), drawing.volumes);
    }

    bool emulatesEverywhere() const {
        return fidelity.fidelity == Fidelity::Chip && effects && effects->has(Effect::Emulation);
    }

    /// What the chip lacks, and what the silhouette's builder can't take.
    std::vector<Missing> missingOf(const Profile& profile, const Axes& axes, const Plan& plan) {
        std::vector<Missing> all = missing(profile, plan);
        if (all.empty() && fidelity.fidelity == Fidelity::Chip) {
            const ChipArithmetic chip = arithmeticOf(profile, fidelity);
            for (const Pass& pass : plan.passes) {
                const auto what = blendUnitLacks(bufferFormatOf(profile), chip, pass);
                if (!what) continue;
                all.push_back({"blend_units", *what, profile.sourceOf("blend_units")});
                break;
            }
        }
        if (axes.store == Store::None || axes.store == Store::DepthMap) return all;
        auto [at, isNew] = refusals.try_emplace({axes.silhouette, axes.capFaces});
        if (isNew) at->second = refusal(scene(), axes.silhouette, axes.capFaces);
        if (at->second)
            all.push_back({"silhouette", *at->second,
                           axes.capFaces == CapFaces::Away ? "Aldridge and Woods, section 2"
                                                           : "Crow 1977; Bergeron 1986"});
        return all;
    }

    /// How deep volumes may nest in the mask, and whether that is too deep.
    void addNesting(Cell& cell, const Profile& profile, const Axes& axes, const Plan& plan) {
        if (axes.store == Store::None || axes.store == Store::DepthMap) return;
        for (int i = 0; i < lights(); ++i) cell.nesting = deepest(cell.nesting, nestingOf(axes, i));
        const bool doubled = plan.masks.empty() || !plan.masks.front().alphaTest.enabled;
        if (const auto warning = nestingWarning(capacity(axes, profile, doubled), cell.nesting))
            cell.warnings.push_back(*warning);
    }

    /// Milliseconds that the host needs to build what @p drawing draws besides the surfaces.
    double buildMs(const Profile& profile, const Drawing& drawing) {
        const Axes& axes = drawing.axes;
        if (axes.store == Store::None) return 0;
        const auto& passes = drawing.plan.passes;
        const bool byShader = std::any_of(passes.begin(), passes.end(),
                                          [](const Pass& pass) { return pass.drawn == Drawn::Silhouettes; });
        const double start = threadCpuMs();
        for (int i = 0; i < lights(); ++i) {
            if (axes.store == Store::DepthMap) {
                depthMapFrame(scene(), light(i), surfacesOf());
                continue;
            }
            // The mesh with its adjacency is made once for a scene, as the finder's edges are.
            if (byShader && axes.count != Count::PlusPlusZp) continue;
            const auto casters = finder().lit(light(i).position, axes.silhouette, axes.capFaces);
            const VolumeKey k = volumeKey(profile, axes, i);
            if (!byShader) frameVolumes(scene(), casters, light(i).position, view(), k.parts, k.style);
            if (axes.count == Count::PlusPlusZp) eyeBlockers(scene(), casters, light(i).position, view().eye);
        }
        return threadCpuMs() - start;
    }

    FrameTime timed(const Profile& profile, const Drawing& drawing, bool byPass) {
        FrameTime time{.buildMs = buildMs(profile, drawing)};
        const Rendered rendered = drawOnce(profile, drawing, {.timesPasses = byPass});
        time.drawMs = rendered.cpuMs;
        if (!byPass) return time;
        const auto& passes = drawing.plan.passes;
        const auto isVolume = [](const Pass& pass) { return pass.kind == PassKind::Volume; };
        const auto first = std::find_if(passes.begin(), passes.end(), isVolume);
        const auto last = std::find_if(passes.rbegin(), passes.rend(), isVolume).base();
        for (auto pass = first; pass < last; ++pass)
            time.maskMs += rendered.passMs[std::size_t(pass - passes.begin())];
        return time;
    }

    Rendered drawOnce(const Profile& profile, const Drawing& drawing, RenderOptions options = {}) {
        const auto& passes = drawing.plan.passes;
        if (stageListener)
            options.beforePass = [&](std::size_t pass) {
                enter(fmt::format("pass {} of {}: {}", pass + 1, passes.size(), passes[pass].label));
            };
        return render(contextOf(profile, drawing.plan, fidelity), profile, drawing.plan, surfacesOf(),
                      lightFrames(*this, profile, drawing), options);
    }

    void draw(Cell& cell, const Profile& profile, const Drawing& drawing, Pictures* pictures,
              const std::function<void(Surface&, std::size_t)>& afterPass) {
        const Plan& plan = drawing.plan;
        cell.unshadowedMs = unshadowedMs(profile);
        Surface& surface = contextOf(profile, plan, fidelity);
        AfterPass each;
        if (afterPass) each = [&](std::size_t pass) { afterPass(surface, pass); };
        Rendered rendered = drawOnce(profile, drawing, {.afterPass = each});
        // Once more for the time: the first may compile the driver's programs, or wait for a caller.
        cell.cpuMs = drawOnce(profile, drawing).cpuMs;
        // Without masks nothing is in shadow; a light that was left out has none.
        const bool isMasked = !plan.masks.empty();
        rendered.masks.resize(std::size_t(lights()), isMasked ? std::vector<bool>{} : rendered.masks.front());
        rendered.values.resize(std::size_t(lights()),
                               isMasked ? std::vector<std::uint16_t>{} : rendered.values.front());

        cell.touched = sumOf(amountsOf(*this, profile, drawing)).pixels;
        cell.passes = rendered.counts.passes;
        if (cell.passes != countPasses(plan))
            throw std::runtime_error("the passes counted at the capability layer are not those of the plan");
        cell.vertices = rendered.counts.vertices;
        cell.clock = name(clockOf(surface));
        const Judgement judgement =
            lights() == 0 ? unmasked(pictures) : judged(cell, profile, drawing, rendered, pictures);
        cell.tiedTruth = judgement.tiedTruth, cell.tiedCount = judgement.tiedCount;
        cell.wrongEdge = judgement.edge, cell.wrongInterior = judgement.interior;
        cell.verdict = judgement.interior ? Verdict::Wrong : judgement.edge ? Verdict::Edge : Verdict::Exact;
        surface.makeCurrent();
        cell.digest = digestOf(rendered);
        if (!pictures) return;
        pictures->image = rendered.image, pictures->judgement = judgement;
        pictures->masks = std::move(rendered.masks);
    }

    /// Of a frame without lights: there is no mask, and no shadow that it could miss.
    Judgement unmasked(Pictures* pictures) const {
        const auto pixels = std::size_t(key().width) * std::size_t(key().height);
        const Image white{key().width, key().height, 1, std::vector<std::uint8_t>(pixels, 255)};
        if (pictures) pictures->mask = pictures->truth = white, pictures->causes.assign(pixels, Cause::None);
        Judgement judgement;
        judgement.pixels.assign(pixels, PixelVerdict::Right);
        judgement.tiedByTruth.assign(pixels, false);
        return judgement;
    }

    /// Holds each light's mask against its truth; adds causes, and the pictures of masks and truth.
    Judgement judged(Cell& cell, const Profile& profile, const Drawing& drawing, const Rendered& rendered,
                     Pictures* pictures) {
        const Axes& axes = drawing.axes;
        const BufferFormat format = bufferFormatOf(profile);
        const ChipArithmetic chip = arithmeticOf(profile, fidelity);
        const bool clamps = axes.arithmetic != Arithmetic::Count;
        std::vector<Judgement> judgements;
        std::vector<Image> masks, truthPictures;
        std::vector<Cause> causes(std::size_t(key().width) * std::size_t(key().height));
        for (int i = 0; i < lights(); ++i) {
            if (rendered.masks[std::size_t(i)].empty()) continue;  // of a light that was left out
            enter(kTruthStage);
            const auto truth = truthOf(i, format.depth, chip.depth, axes.silhouette);
            enter("the prediction");
            const std::vector<bool>& mask = rendered.masks[std::size_t(i)];
            judgements.push_back(judge(*truth, mask, axes.maskDivisor, clamps));
            if (pictures) {
                masks.push_back(shadowPicture(*truth, mask));
                truthPictures.push_back(truthPicture(*truth));
                pictures->judgements.push_back(judgements.back());
                pictures->truths.push_back(truth);
            }
            const Explained one = explained(profile, drawing, format, chip, i, *truth, judgements.back(),
                                            rendered.values[std::size_t(i)]);
            cell.unpredicted += one.unpredicted;
            // Of several lights that are wrong in a pixel the first explains it.
            for (std::size_t p = 0; p < one.causes.size(); ++p)
                if (causes[p] == Cause::None) causes[p] = one.causes[p];
        }
        for (const Cause cause : causes)
            if (cause != Cause::None) ++cell.causes[gnomon::name(cause)];
        if (pictures) pictures->causes = causes;
        if (pictures) pictures->mask = averageOf(masks), pictures->truth = averageOf(truthPictures);
        return combined(judgements);
    }

    /// One light's mask held against its prediction.
    Explained explained(const Profile& profile, const Drawing& drawing, const BufferFormat& format,
                        const ChipArithmetic& chip, int index, const Truth& truth, const Judgement& judgement,
                        std::span<const std::uint16_t> values) {
        const Axes& axes = drawing.axes;
        const bool hasVolumes =
            axes.store != Store::None && axes.store != Store::DepthMap && axes.count != Count::AtomicZp;
        const auto drawn = hasVolumes ? drawnVolumes(*this, profile, drawing, index)
                                      : std::make_shared<const FrameVolumes>();
        return planner.predictor().explain({.plan = drawing.plan,
                                            .axes = axes,
                                            .format = format,
                                            .chip = chip,
                                            .light = index,
                                            .truth = truth,
                                            .judgement = judgement,
                                            .values = values,
                                            .ordinals = drawn->ordinals,
                                            .leavesOut = !drawing.isFull});
    }
};

Lab::Lab(Scene scene) : m_impl(std::make_unique<Impl>(std::move(scene))) {}
Lab::~Lab() = default;

const Scene& Lab::scene() const {
    return m_impl->scene();
}

void Lab::use(const FidelityChoice& choice) {
    m_impl->fidelity = choice;
}

void Lab::drawOn(Device device) {
    Impl& m = *m_impl;
    if (m.device == device) return;
    m.device = device;
    m.contexts.clear(), m.results.clear(), m.unshadowed.clear();
}

void Lab::simulate(const std::optional<Effects>& effects) {
    m_impl->effects = effects;
}

const std::optional<Effects>& Lab::simulated() const {
    return m_impl->effects;
}

void Lab::onStage(std::function<void(const std::string&)> listener) {
    m_impl->stageListener = std::move(listener);
}

void Lab::onDrawn(std::function<void(const Cell&, const Pictures&)> listener) {
    m_impl->drawnListener = std::move(listener);
}

Nesting Lab::nesting(const Axes& axes, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    Nesting all;
    for (int i = 0; i < m_impl->lights(); ++i) all = deepest(all, m_impl->nestingOf(normalised(axes), i));
    return all;
}

Plan Lab::plan(const Profile& profile, const Axes& axes, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    return m_impl->planOf(profile, normalised(axes));
}

MinimalPlan Lab::minimalPlan(const Profile& profile, const Axes& axes, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    return m_impl->minimalOf(profile, normalised(axes));
}

int Lab::wrongPixels(const Profile& profile, const MinimalPlan& minimal, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    return m_impl->planner.wrongPixels(profile, drawingOf(minimal), m_impl->fidelity);
}

std::vector<std::vector<FrameTime>> Lab::frameTimes(std::span<const TimedWay> ways, int width, int height,
                                                    int frame, int repeats, bool byPass,
                                                    const ProgressListener& progress) {
    Impl& m = *m_impl;
    m.select({width, height, frame});
    const auto effects = m.effects;
    const auto fidelity = m.fidelity;
    const auto as = [&](const TimedWay& way) { m.effects = way.effects, m.fidelity = way.fidelity; };
    std::vector<Drawing> drawings;
    for (const TimedWay& way : ways) {
        as(way);
        drawings.push_back(m.drawingOf(way.profile, normalised(way.axes)));
        if (way.shaderVolumes) drawings.back().plan = withShaderVolumes(std::move(drawings.back().plan));
    }
    std::vector<std::vector<FrameTime>> times(ways.size());
    Progress at{.all = ways.size() * (std::size_t(repeats) + 1)};
    for (int round = 0; round <= repeats; ++round)
        for (std::size_t i = 0; i < ways.size(); ++i, ++at.done) {
            if (progress) progress(at);
            as(ways[i]);
            const FrameTime time = m.timed(ways[i].profile, drawings[i], byPass);
            if (round > 0) times[i].push_back(time);
        }
    m.effects = effects, m.fidelity = fidelity;
    return times;
}

std::vector<DrawnAmount> Lab::amounts(const Profile& profile, const MinimalPlan& minimal, int width,
                                      int height, int frame) {
    m_impl->select({width, height, frame});
    return amountsOf(*m_impl, profile, drawingOf(minimal));
}

std::vector<DrawnAmount> Lab::fullAmounts(const Profile& profile, const Axes& given, int width, int height,
                                          int frame) {
    m_impl->select({width, height, frame});
    const Axes axes = normalised(given);
    return amountsOf(*m_impl, profile, {.axes = axes, .plan = m_impl->planOf(profile, axes)});
}

FrameCost Lab::cost(const Profile& profile, const MinimalPlan& minimal, int width, int height, int frame,
                    double hostMs) {
    m_impl->select({width, height, frame});
    return m_impl->costOf(profile, drawingOf(minimal), hostMs);
}

FrameCost Lab::drawnCost(const Profile& profile, const Axes& axes, int width, int height, int frame,
                         double hostMs) {
    m_impl->select({width, height, frame});
    return m_impl->costOf(profile, m_impl->drawingOf(profile, normalised(axes)), hostMs);
}

FrameCost Lab::fullCost(const Profile& profile, const Axes& given, int width, int height, int frame,
                        double hostMs) {
    m_impl->select({width, height, frame});
    const Axes axes = normalised(given);
    return m_impl->costOf(profile, {.axes = axes, .plan = m_impl->planOf(profile, axes)}, hostMs);
}

std::vector<Missing> Lab::missingFor(const Profile& profile, const Axes& axes, const Plan& plan) {
    return m_impl->missingOf(profile, normalised(axes), plan);
}

std::vector<Lab::Candidate> Lab::path(const Profile& profile, int width, int height, int frame) {
    m_impl->select({width, height, frame});
    std::vector<Candidate> tried;
    for (Axes axes : pathCandidates()) {
        bool inside = false;
        for (int i = 0; i < m_impl->lights() && !inside; ++i) inside = m_impl->eyeInVolumes(i);
        if (axes.store == Store::Stencil && inside) axes.count = Count::ZpassCap;
        tried.push_back({axes, missing(profile, m_impl->planOf(profile, axes))});
        if (tried.back().missing.empty()) break;
    }
    return tried;
}

Cell Lab::runChosen(const Profile& profile, const Axes& given, int width, int height, int frame,
                    Pictures* pictures, const std::function<void(Surface&, std::size_t)>& afterPass) {
    const auto effects = simulated();
    const auto all = options(*this, profile, given.shade, width, height, frame);
    const Choice choice = choose(*this, profile, all, width, height, frame);
    simulate(effects.value_or(Effects::none()));
    Cell cell = run(profile, choice.option.axes, width, height, frame, pictures, afterPass);
    simulate(effects);
    cell.drawnBy = choice.option.method;
    cell.method = methodId(given);
    cell.proof = choice.proof;
    return cell;
}

Cell Lab::run(const Profile& profile, const Axes& given, int width, int height, int frame, Pictures* pictures,
              const std::function<void(Surface&, std::size_t)>& afterPass) {
    if (given.automatic) return runChosen(profile, given, width, height, frame, pictures, afterPass);
    m_impl->select({width, height, frame});
    const Axes axes = normalised(given);
    Cell cell;
    cell.profile = profile.id, cell.method = methodId(axes), cell.scene = m_impl->scene().id;
    cell.axes = axes;
    cell.width = width, cell.height = height, cell.frame = frame;
    cell.pixels = width * height;
    cell.lights = m_impl->lights();
    cell.fidelity = name(m_impl->fidelity.fidelity), cell.device = name(m_impl->device);
    cell.effects = m_impl->effects.value_or(Effects::all());
    try {
        const Plan plan = m_impl->planOf(profile, axes);
        cell.missing = m_impl->missingOf(profile, axes, plan);
        if (!cell.missing.empty()) {
            cell.verdict = Verdict::Refused;
            cell.passes = countPasses(plan);
            return cell;
        }
        m_impl->addNesting(cell, profile, axes, plan);
        const Drawing drawing = m_impl->drawingOf(profile, axes);
        const std::string key = m_impl->keyOf(profile, drawing);
        const auto known = m_impl->results.find(key);
        if (known != m_impl->results.end() && !pictures && !afterPass) {
            Cell same = known->second;
            same.profile = profile.id;
            same.method = cell.method;
            same.axes = axes;
            same.effects = cell.effects;
            same.nesting = cell.nesting, same.warnings = cell.warnings;
            return same;
        }
        Pictures drawn;
        const bool isTold = bool(m_impl->drawnListener);
        m_impl->draw(cell, profile, drawing, pictures ? pictures : isTold ? &drawn : nullptr, afterPass);
        if (isTold) m_impl->drawnListener(cell, pictures ? *pictures : drawn);
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
