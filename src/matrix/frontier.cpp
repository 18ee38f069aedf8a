#include "matrix/frontier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "image/difference.h"
#include "image/distance.h"

namespace gnomon {
namespace {

/// Adds the distances of the wrong pixels of one light from truth's boundary.
void addDistances(ErrorSum& sum, const Judgement& judgement, const Truth& truth) {
    const auto isWrong = [](PixelVerdict v) {
        return v == PixelVerdict::WrongEdge || v == PixelVerdict::WrongInterior;
    };
    if (std::none_of(judgement.pixels.begin(), judgement.pixels.end(), isWrong)) return;
    std::vector<bool> dark(truth.shadow.size()), light(truth.shadow.size());
    for (std::size_t i = 0; i < dark.size(); ++i) {
        dark[i] = truth.shadow[i] == Shadow::InShadow;
        light[i] = !dark[i];
    }
    const auto toDark = squaredDistances(dark, truth.width, truth.height);
    const auto toLight = squaredDistances(light, truth.width, truth.height);
    for (std::size_t i = 0; i < dark.size(); ++i) {
        if (!isWrong(judgement.pixels[i])) continue;
        const std::int64_t square = dark[i] ? toLight[i] : toDark[i];
        if (square == kNoDistance) continue;
        const double distance = std::sqrt(double(square));
        ++sum.measured;
        sum.distanceSum += distance;
        sum.largestDistance = std::max(sum.largestDistance, distance);
    }
}

/// The image of one frame as truth would have it, and what is not sure of it.
struct Reference {
    Image image{};
    std::vector<bool> tied{};
};

std::vector<bool> tiedPixels(const Judgement& judgement) {
    std::vector<bool> tied;
    for (const PixelVerdict verdict : judgement.pixels) tied.push_back(verdict == PixelVerdict::Tied);
    return tied;
}

/// Draws with the reference chip, in the buffers of the chip that is studied.
std::optional<Reference> referenceOf(Lab& lab, const CostRequest& request, Shade shade, int frame) {
    Profile chip = request.reference;
    chip.id += " as " + request.profile.id;
    chip.colourFormats = request.profile.colourFormats;
    chip.depthBits = request.profile.depthBits;
    lab.use({});
    lab.simulate({});
    for (const char* id : {"carmack", "counter"}) {
        Axes axes = findMethod(id)->axes;
        axes.shade = shade;
        Pictures pictures;
        const Cell cell = lab.run(chip, axes, request.width, request.height, frame, &pictures);
        if (cell.verdict == Verdict::Exact)
            return Reference{std::move(pictures.image), tiedPixels(pictures.judgement)};
    }
    return std::nullopt;
}

/// One study, frame by frame.
class Study {
  public:
    Study(Lab& lab, const CostRequest& request, const std::function<void(std::size_t, std::size_t)>& progress)
        : m_lab(lab), m_request(request), m_progress(progress) {
        m_result = {.profile = request.profile.id,
                    .scene = lab.scene().id,
                    .width = request.width,
                    .height = request.height,
                    .repeats = request.repeats,
                    .frames = request.frames,
                    .hasModelRates = hasModelRates(request.profile)};
        for (const CostSetting& setting : request.settings) m_result.rows.push_back({.setting = setting});
    }

    CostStudy run() {
        const auto effects = m_lab.simulated();
        for (const int frame : m_request.frames) {
            judge(frame);
            time(frame);
        }
        m_lab.simulate(effects);
        m_lab.use({});
        finish();
        return std::move(m_result);
    }

  private:
    Lab& m_lab;
    const CostRequest& m_request;
    const std::function<void(std::size_t, std::size_t)>& m_progress;
    CostStudy m_result{};
    std::vector<TimedWay> m_ways{};  ///< by row: with the axes that are drawn in this frame
    std::vector<double> m_unshadowedMs{};
    std::size_t m_done = 0;

    void step() {
        // Each setting is a step in each frame, and so are all its timings.
        const std::size_t all = m_request.frames.size() * (m_request.settings.size() + 1);
        if (m_progress) m_progress(++m_done, all);
    }

    void judge(int frame) {
        std::map<Shade, std::optional<Reference>> references;
        m_ways.clear();
        bool isCompared = true;
        for (CostRow& row : m_result.rows) {
            TimedWay way = row.setting.way;
            const Shade shade = way.axes.shade;
            if (row.isDrawn())
                judgeRow(row, way, frame, [&]() -> const std::optional<Reference>& {
                    if (!references.contains(shade))
                        references[shade] = referenceOf(m_lab, m_request, shade, frame);
                    return references[shade];
                });
            isCompared = isCompared && (!references.contains(shade) || references[shade]);
            m_ways.push_back(way);
            step();
        }
        m_result.framesCompared += isCompared;
    }

    /// @param way           gets the axes that are drawn
    /// @param referenceFor  is asked for only if something is
    void judgeRow(CostRow& row, TimedWay& way, int frame,
                  const std::function<const std::optional<Reference>&()>& referenceFor) {
        m_lab.use(way.fidelity);
        m_lab.simulate(way.effects);
        Pictures pictures;
        const Cell cell =
            m_lab.run(way.profile, way.axes, m_request.width, m_request.height, frame, &pictures);
        row.missing = cell.missing, row.failure = cell.error;
        if (!row.isDrawn()) return;
        if (way.axes.automatic) {
            way.axes = cell.axes, way.effects = cell.effects;
            if (row.drawnBy.find(cell.drawnBy) == std::string::npos)
                row.drawnBy += (row.drawnBy.empty() ? "" : ", ") + cell.drawnBy;
        }
        ErrorSum& error = row.error;
        error.edge += cell.wrongEdge, error.interior += cell.wrongInterior;
        error.tied += cell.tiedTruth + cell.tiedCount;
        for (std::size_t i = 0; i < pictures.truths.size(); ++i)
            addDistances(error, pictures.judgements[i], *pictures.truths[i]);
        if (const auto& reference = referenceFor()) {
            std::vector<bool> leftOut = tiedPixels(pictures.judgement);
            for (std::size_t i = 0; i < leftOut.size(); ++i) leftOut[i] = leftOut[i] || reference->tied[i];
            error.squares.push_back(meanSquaredDifference(pictures.image, reference->image, leftOut));
        }
        row.passes.scene += cell.passes.scene, row.passes.volume += cell.passes.volume;
        row.passes.rectangle += cell.passes.rectangle, row.passes.copy += cell.passes.copy;
        row.amount.pixels += cell.touched;
        row.amount.vertices += cell.vertices;
        m_lab.use(way.fidelity);  // the reference was drawn with OpenGL's
        m_lab.simulate(way.effects);
        row.model.add(m_lab.drawnCost(way.profile, way.axes, m_request.width, m_request.height, frame));
        m_result.device = cell.device, m_result.clock = cell.clock;
    }

    void time(int frame) {
        // Before each way its own unshadowed frame, of the same chip, buffers and arithmetic: twice, so that
        // what is measured follows on such a frame in both.
        std::vector<TimedWay> ways;
        std::vector<CostRow*> rows;
        std::map<std::pair<BufferFormat, ChipArithmetic>, std::vector<std::size_t>> alike;  ///< of rows
        for (std::size_t i = 0; i < m_ways.size(); ++i) {
            if (!m_result.rows[i].isDrawn()) continue;
            const TimedWay& way = m_ways[i];
            alike[{bufferFormatOf(way.profile), arithmeticOf(way.profile, way.fidelity)}].push_back(
                rows.size());
            rows.push_back(&m_result.rows[i]);
            ways.insert(ways.end(), 2, {way.profile, normalised({.store = Store::None}), way.fidelity, {}});
            ways.push_back(way);
        }
        const auto times = m_lab.frameTimes(ways, m_request.width, m_request.height, frame,
                                            m_request.repeats * kDrawingsPerRound);
        for (int round = 0; round < m_request.repeats; ++round) {
            const auto best = [&](std::size_t way) {
                const auto first = times[way].begin() + round * kDrawingsPerRound;
                return std::min_element(first, first + kDrawingsPerRound, isShorter)->total();
            };
            for (const auto& [format, members] : alike) {
                std::vector<double> bare;
                for (const std::size_t row : members) bare.push_back(best(3 * row + 1));
                const double unshadowed = spreadOf(bare).median;
                m_unshadowedMs.push_back(unshadowed);
                for (const std::size_t row : members) {
                    rows[row]->times.push_back(best(3 * row + 2));
                    rows[row]->ratios.push_back(rows[row]->times.back() / unshadowed);
                }
            }
        }
        step();
    }

    static bool isShorter(const FrameTime& a, const FrameTime& b) { return a.total() < b.total(); }

    void finish() {
        m_result.unshadowedMs = spreadOf(m_unshadowedMs).median;
        std::vector<CostRow>& rows = m_result.rows;
        for (CostRow& row : rows) row.ratio = spreadOf(row.ratios), row.ms = spreadOf(row.times);
        markFrontiers();
        const auto rank = [](const CostRow& row) {
            const double last = std::numeric_limits<double>::infinity();
            return row.isDrawn() ? std::pair(double(row.error.wrong()), row.ratio.median)
                                 : std::pair(last, last);
        };
        std::stable_sort(rows.begin(), rows.end(),
                         [&](const CostRow& a, const CostRow& b) { return rank(a) < rank(b); });
    }

    void markFrontiers() {
        std::vector<CostRow*> drawn;
        std::vector<Bargain> byTime, byTouched, byModel;
        for (CostRow& row : m_result.rows) {
            if (!row.isDrawn()) continue;
            drawn.push_back(&row);
            byTime.push_back({double(row.error.wrong()), row.ratio.median});
            byTouched.push_back({double(row.error.wrong()), double(row.amount.pixels.total())});
            byModel.push_back({double(row.error.wrong()), row.model.ms});
        }
        const std::vector<bool> time = onFrontier(byTime), touched = onFrontier(byTouched),
                                model = onFrontier(byModel);
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            drawn[i]->onTimeFrontier = time[i], drawn[i]->onTouchedFrontier = touched[i];
            drawn[i]->onModelFrontier = m_result.hasModelRates && model[i];
        }
    }
};

}  // namespace

void ModelSum::add(const FrameCost& frame) {
    for (const PassCost& pass : frame.passes) {
        bytes += pass.traffic.bytes(), busBytes += pass.traffic.busBytes;
        fillMs += pass.fillMs, bandwidthMs += pass.bandwidthMs;
        triangleMs += pass.triangleMs, busMs += pass.busMs;
    }
    ms += frame.ms();
    if (frame.ms() > longestMs) longestMs = frame.ms(), limit = frame.limit();
    for (const std::string& what : frame.missing)
        if (std::find(missing.begin(), missing.end(), what) == missing.end()) missing.push_back(what);
}

std::optional<double> ErrorSum::rms() const {
    if (squares.empty()) return std::nullopt;
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size()));
}

std::optional<double> ErrorSum::psnr() const {
    const auto root = rms();
    return root ? std::optional(psnrOf(*root * *root)) : std::nullopt;
}

int defaultRepeats(std::size_t frames) {
    const int all = CostRequest{}.repeats;
    return std::max(1, (all + int(frames) - 1) / std::max(1, int(frames)));
}

std::vector<bool> onFrontier(std::span<const Bargain> all) {
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(all[a].cost, all[a].error) < std::pair(all[b].cost, all[b].error);
    });
    std::vector<bool> isOn(all.size());
    const Bargain* last = nullptr;  // the frontier so far
    for (const std::size_t i : order) {
        const bool isSame = last && all[i].cost == last->cost && all[i].error == last->error;
        if (last && !isSame && all[i].error >= last->error) continue;
        isOn[i] = true;
        last = &all[i];
    }
    return isOn;
}

CostStudy costStudy(Lab& lab, const CostRequest& request,
                    const std::function<void(std::size_t, std::size_t)>& progress) {
    return Study(lab, request, progress).run();
}

}  // namespace gnomon
