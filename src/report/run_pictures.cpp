#include "report/run_pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include "matrix/film_strip.h"
#include "matrix/lab.h"
#include "matrix/pool.h"
#include "matrix/result_key.h"
#include "report/deflate.h"
#include "report/listings.h"
#include "report/plan_notes.h"
#include "report/run_json.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSecondsPerJob = 1800;

bool isDrawn(const Cell& cell) {
    return cell.verdict != Verdict::Refused && cell.verdict != Verdict::Failed;
}

/// What a cell asks, whatever its frame.
std::string withoutFrame(Cell cell) {
    cell.frame = 0;
    return cell.question();
}

FidelityChoice choiceOf(const Cell& cell) {
    FidelityChoice choice{.fidelity = cell.fidelity == name(Fidelity::Chip) ? Fidelity::Chip : Fidelity::Gl,
                          .dithers = cell.dithers};
    for (int unit = 0; unit <= int(BlendUnit::Nv2a); ++unit)
        if (!cell.blendUnit.empty() && name(BlendUnit(unit)) == cell.blendUnit) choice.unit = BlendUnit(unit);
    return choice;
}

/// The passes of @p plan with their reasons; volume passes beyond the first are folded.
std::string passesText(const Plan& plan) {
    const std::vector<std::size_t> shown = stripPasses(plan, kShownVolumes);
    std::string text;
    std::size_t last = 0;
    for (const std::size_t i : shown) {
        const Pass& pass = plan.passes[i];
        if (i > last + 1) text += fmt::format("... {} more volume passes\n", i - last - 1);
        text += fmt::format("{} {}: {}\n  {}\n  why: {}\n", i + 1, kindName(pass.kind), pass.label,
                            describeState(pass, plan.windows), reasonFor(plan, i, {}));
        last = i;
    }
    return text;
}

/// |mask - truth|: what is not zero is wrong, or tied.
Image differenceOf(const Image& mask, const Image& truth) {
    Image out = mask;
    for (std::size_t i = 0; i < out.data.size(); ++i)
        out.data[i] = std::uint8_t(std::abs(int(mask.data[i]) - int(truth.data[i])));
    return out;
}

Image causesOf(const Image& mask, const std::vector<Cause>& causes) {
    Image out{mask.width, mask.height, 1, std::vector<std::uint8_t>(mask.data.size())};
    for (std::size_t i = 0; i < causes.size(); ++i) out.data[i] = std::uint8_t(causes[i]);
    return out;
}

/// What was found of a cell: its pictures, their judgement, and its passes.
std::map<std::string, Json> outcomesOf(const Cell& cell) {
    static const std::set<std::string> keys{
        "digest",     "verdict",     "causes",       "wrong.edge",    "wrong.interior",   "tied.truth",
        "tied.count", "unpredicted", "passes.scene", "passes.volume", "passes.rectangle", "passes.copy"};
    std::map<std::string, Json> outcomes;
    for (auto& [key, value] : flatCell(cell))
        if (keys.contains(key)) outcomes.emplace(key, std::move(value));
    return outcomes;
}

/// The keys of outcomesOf() in which two drawings of one cell differ.
std::vector<std::string> differingOutcomes(const Cell& a, const Cell& b) {
    const auto before = outcomesOf(a), after = outcomesOf(b);
    std::vector<std::string> keys;
    for (const auto& [key, value] : before)
        if (after.at(key) != value) keys.push_back(key);
    return keys;
}

/// Shown cells that share truth and geometry: one process draws them.
struct Group {
    std::vector<std::size_t> cells{}, refused{};
};

std::vector<Group> groupsOf(const std::vector<Cell>& cells) {
    std::vector<Group> groups;
    std::map<std::tuple<std::string, std::map<std::string, std::string>, int, int, int>, std::size_t> known;
    const auto groupOf = [&](std::size_t i) -> Group& {
        const Cell& c = cells[i];
        const auto [at, isNew] =
            known.try_emplace({c.scene, c.view, c.width, c.height, c.frame}, groups.size());
        if (isNew) groups.emplace_back();
        return groups[at->second];
    };
    for (const std::size_t i : shownCells(cells)) groupOf(i).cells.push_back(i);
    for (const std::size_t i : refusedCells(cells)) groupOf(i).refused.push_back(i);
    return groups;
}

/// Draws the cells of one group into a pack.
class GroupDrawer {
  public:
    GroupDrawer(const std::vector<Cell>& cells, const RunSources& sources, const Cell& first)
        : m_cells(cells), m_sources(sources), m_lab(sources.scenes.at({first.scene, first.view})) {}

    void draw(std::size_t index) {
        const Cell& cell = m_cells[index];
        const Profile& profile = m_sources.profiles.at(cell.profile);
        const FidelityChoice choice = choiceOf(cell);
        for (int d = 0; d < kDevices; ++d)
            if (cell.device == name(Device(d))) m_lab.drawOn(Device(d));
        m_lab.use(choice);
        const bool isFull = cell.effects == Effects::all();
        m_lab.simulate(isFull ? std::nullopt : std::optional(cell.effects));
        const Plan plan = drawnPlan(m_lab, profile, cell.axes, cell.width, cell.height, cell.frame);
        // What is drawn alike may still have another strip, or be judged otherwise.
        const std::string key = fmt::format(
            "{} {} {} {} {}",
            resultKey(bufferFormatOf(profile), arithmeticOf(profile, choice), plan, cell.axes, {}),
            profile.depthClamp, name(cell.axes.silhouette), cell.device, Json(outcomesOf(cell)).dump());
        const auto [at, isNew] = m_known.try_emplace(key, m_drawings.size());
        if (!isNew) {
            m_drawings[at->second].cells.push_back(index);
            return;
        }
        m_drawings.push_back({.cells = {index}, .plan = passesText(plan)});
        fill(m_drawings.back(), cell, profile, plan);
    }

    /// The passes of a cell that is refused.
    std::string refusedPlan(std::size_t index) {
        const Cell& cell = m_cells[index];
        return passesText(
            m_lab.plan(m_sources.profiles.at(cell.profile), cell.axes, cell.width, cell.height, cell.frame));
    }

    void finish() { m_pack.finish(); }

    const std::vector<CellDrawing>& drawings() const { return m_drawings; }
    const PicturePack& pack() const { return m_pack; }

  private:
    void fill(CellDrawing& drawing, const Cell& cell, const Profile& profile, const Plan& plan) {
        std::vector<StripPicture> steps;
        Pictures pictures;
        const MaskBuffer buffer = maskBufferOf(plan);
        const Cell again =
            m_lab.run(profile, cell.axes, cell.width, cell.height, cell.frame, &pictures,
                      stripReader(stripPasses(plan, kShownVolumes), buffer,
                                  [&](StripPicture step) { steps.push_back(std::move(step)); }));
        if (again.verdict == Verdict::Failed) drawing.error = again.error;
        if (again.verdict == Verdict::Refused)
            drawing.error = fmt::format("it is refused: the chip lacks {}", again.missing.front().what);
        if (!drawing.error.empty()) return;
        drawing.differs = differingOutcomes(cell, again);
        drawing.chunk = m_pack.beginChunk();
        const auto add = [&](const char* what, const Image& image, PictureKind kind, std::vector<int>& like) {
            // A strip is to build on the image.
            const int index = m_pack.add(image, kind, like, kind == PictureKind::Rgb ? 1 : 2);
            drawing.pictures.emplace_back(what, index);
            if (std::find(like.begin(), like.end(), index) == like.end()) like.push_back(index);
            // The first, and the last few: chips of one format follow each other seldom, methods often.
            constexpr std::size_t kMost = 12;
            if (like.size() > kMost) like.erase(like.begin() + 1);
            return index;
        };
        const int image = add("image", pictures.image, PictureKind::Rgb, m_images);
        add("truth", pictures.truth, PictureKind::Grey, m_shadows);
        add("mask", pictures.mask, PictureKind::Grey, m_shadows);
        add("causes", causesOf(pictures.mask, pictures.causes), PictureKind::Cause, m_causes);
        add("difference", differenceOf(pictures.mask, pictures.truth), PictureKind::Grey, m_differences);

        fillStrip(drawing, cell.method, plan, buffer, steps, image);
    }

    /// Strips of one method look alike pass by pass, whatever the chip.
    void fillStrip(CellDrawing& drawing, const std::string& method, const Plan& plan, MaskBuffer buffer,
                   const std::vector<StripPicture>& steps, int image) {
        if (method != m_method) {
            m_pack.dropBytes(m_stripPictures);
            m_stripPictures.clear(), m_stripOf.clear();
            m_method = method;
        }
        const int first = m_pack.size();
        drawing.stripChunk = m_pack.beginChunk();
        const bool isFirst = m_stripOf.empty();
        std::vector<int> colours{image}, masks;
        const auto add = [&](const Image& picture, PictureKind kind, const std::string& of, std::size_t pass,
                             std::vector<int>& own) {
            std::vector<int>& others = m_stripOf[{of, pass}];
            std::vector<int> like = own;
            like.insert(like.end(), others.begin(), others.end());
            const int index = m_pack.add(picture, kind, like, isFirst ? 1 : 2);
            if (std::find(own.begin(), own.end(), index) == own.end()) own.push_back(index);
            if (std::find(others.begin(), others.end(), index) == others.end()) others.push_back(index);
            return index;
        };
        for (const StripPicture& step : steps) {
            StripFrame frame{.pass = step.pass + 1,
                             .title = plan.passes[step.pass].label,
                             .why = reasonFor(plan, step.pass, {})};
            frame.buffers.emplace_back("colour",
                                       add(step.colour, PictureKind::Rgb, "colour", step.pass, colours));
            const auto kind = buffer == MaskBuffer::Stencil ? PictureKind::Count : PictureKind::Grey;
            if (buffer != MaskBuffer::None)
                frame.buffers.emplace_back(name(buffer),
                                           add(step.mask, kind, name(buffer), step.pass, masks));
            drawing.strip.push_back(std::move(frame));
        }
        for (int picture = first; picture < m_pack.size(); ++picture) m_stripPictures.push_back(picture);
    }

    const std::vector<Cell>& m_cells;
    const RunSources& m_sources;
    Lab m_lab;
    PicturePack m_pack{};
    std::vector<CellDrawing> m_drawings{};
    std::map<std::string, std::size_t> m_known{};
    std::vector<int> m_images{}, m_shadows{}, m_causes{}, m_differences{};
    // Of the method that was drawn last.
    std::string m_method{};
    std::vector<int> m_stripPictures{};
    std::map<std::pair<std::string, std::size_t>, std::vector<int>> m_stripOf{};  ///< by buffer and pass
};

Json toJson(const GroupDrawer& drawer) {
    Json drawings = Json::array(), pictures = Json::array(), chunks = Json::array();
    for (const CellDrawing& d : drawer.drawings()) {
        Json strip = Json::array();
        for (const StripFrame& f : d.strip) strip.push_back({f.pass, f.title, f.why, f.buffers});
        drawings.push_back({d.cells, d.chunk, d.pictures, strip, d.stripChunk, d.plan, d.differs, d.error});
    }
    for (const PackedPicture& p : drawer.pack().pictures())
        pictures.push_back({p.chunk, p.offset, p.width, p.height, p.planes, int(p.kind), p.base});
    for (const PackedChunk& chunk : drawer.pack().chunks())
        chunks.push_back({chunk.length, base64(chunk.deflated)});
    return {drawings, pictures, chunks};
}

/// Adds what one group's process has sent to @p all.
void addGroup(RunPictures& all, const Json& json) {
    const int firstChunk = int(all.chunks.size()), firstPicture = int(all.pictures.size());
    const auto moved = [&](const Json& buffers) {
        std::vector<std::pair<std::string, int>> list = buffers;
        for (auto& [what, picture] : list) picture += firstPicture;
        return list;
    };
    for (const Json& d : json.at(0)) {
        CellDrawing drawing{.cells = d.at(0),
                            .chunk = firstChunk + int(d.at(1)),
                            .pictures = moved(d.at(2)),
                            .stripChunk = d.at(4) < 0 ? -1 : firstChunk + int(d.at(4)),
                            .plan = d.at(5),
                            .differs = d.at(6),
                            .error = d.at(7)};
        for (const Json& f : d.at(3))
            drawing.strip.push_back(
                {.pass = f.at(0), .title = f.at(1), .why = f.at(2), .buffers = moved(f.at(3))});
        all.drawings.push_back(std::move(drawing));
    }
    for (const Json& p : json.at(1)) {
        const int base = p.at(6);
        all.pictures.push_back({.chunk = firstChunk + int(p.at(0)),
                                .offset = p.at(1),
                                .width = p.at(2),
                                .height = p.at(3),
                                .planes = p.at(4),
                                .kind = PictureKind(int(p.at(5))),
                                .base = base < 0 ? -1 : base + firstPicture});
    }
    for (const Json& c : json.at(2)) {
        all.chunks.push_back({fromBase64(std::string(c.at(1))), c.at(0)});
    }
}

/// What a drawing shows that no drawing before it has shown.
void addNews(std::vector<CellDrawing>& drawings, const std::vector<Cell>& cells) {
    std::set<std::string> methods, outcomes;
    for (CellDrawing& drawing : drawings) {
        drawing.news = drawing.differs.empty() && drawing.error.empty() ? 2 : 0;
        for (const std::size_t index : drawing.cells) {
            const Cell& c = cells[index];
            const std::string method =
                fmt::format("{} {} {} {}", c.scene, c.method, name(c.axes.shade), c.fidelity);
            std::string outcome = fmt::format("{} {}", method, name(c.verdict));
            for (const auto& cause : c.causes) outcome += " " + cause.first;
            if (methods.insert(method).second || c.chosen) drawing.news = 0;
            if (outcomes.insert(outcome).second) drawing.news = std::min(drawing.news, 1);
        }
    }
}

}  // namespace

std::vector<std::size_t> shownCells(const std::vector<Cell>& cells) {
    std::vector<std::size_t> shown;
    std::map<std::string, std::size_t> known;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!isDrawn(cells[i])) continue;
        const auto [at, isNew] = known.try_emplace(withoutFrame(cells[i]), shown.size());
        const auto badness = [&](std::size_t c) {
            return std::pair(cells[c].verdict, cells[c].wrongEdge + cells[c].wrongInterior);
        };
        if (isNew)
            shown.push_back(i);
        else if (badness(i) > badness(shown[at->second]))
            shown[at->second] = i;
    }
    std::sort(shown.begin(), shown.end());
    return shown;
}

std::vector<std::size_t> refusedCells(const std::vector<Cell>& cells) {
    std::set<std::string> known;
    for (const Cell& cell : cells)
        if (isDrawn(cell)) known.insert(withoutFrame(cell));
    std::vector<std::size_t> refused;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].verdict == Verdict::Refused && known.insert(withoutFrame(cells[i])).second)
            refused.push_back(i);
    return refused;
}

std::vector<std::pair<std::size_t, std::string>> faultsOf(const RunPictures& pictures) {
    std::vector<std::pair<std::size_t, std::string>> faults;
    for (const CellDrawing& drawing : pictures.drawings) {
        if (drawing.differs.empty() && drawing.error.empty()) continue;
        const std::string what =
            drawing.error.empty()
                ? fmt::format("drawn again, it differs from the run in {}", fmt::join(drawing.differs, ", "))
                : fmt::format("drawn again: {}", drawing.error);
        for (const std::size_t cell : drawing.cells) faults.emplace_back(cell, what);
    }
    std::sort(faults.begin(), faults.end());
    return faults;
}

RunPictures drawRun(const std::vector<Cell>& cells, const RunSources& sources, int jobs,
                    const ProgressListener& progress) {
    const std::vector<Group> groups = groupsOf(cells);
    std::vector<Job> work;
    for (const Group& group : groups) {
        const std::size_t first = group.cells.empty() ? group.refused.front() : group.cells.front();
        work.push_back({cells[first].scene,
                        [&cells, &sources, &group, first](const std::function<void(std::string)>& emit) {
                            GroupDrawer drawer(cells, sources, cells[first]);
                            for (const std::size_t index : group.cells) drawer.draw(index);
                            drawer.finish();
                            Json refused = Json::array();
                            for (const std::size_t index : group.refused)
                                refused.push_back({index, drawer.refusedPlan(index)});
                            emit(Json{toJson(drawer), refused}.dump());
                        }});
    }
    std::vector<std::optional<Json>> results(groups.size());
    std::vector<std::string> errors(groups.size());
    Progress at{.all = shownCells(cells).size()};
    if (progress) progress(at);
    runJobs(work, jobs, kSecondsPerJob, [&](std::size_t job, JobEnd end) {
        if (end.error.empty() && end.lines.size() == 1)
            results[job] = Json::parse(end.lines.front());
        else
            errors[job] = end.error.empty() ? "no pictures" : end.error;
        at.done += groups[job].cells.size();
        if (!errors[job].empty()) at.failures += groups[job].cells.size();
        if (progress) progress(at);
    });
    RunPictures all;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (results[g]) {
            addGroup(all, results[g]->at(0));
            for (const Json& refused : results[g]->at(1))
                all.refusedPlans.emplace(refused.at(0), refused.at(1));
        } else if (!groups[g].cells.empty())
            all.drawings.push_back({.cells = groups[g].cells, .error = errors[g]});
    }
    addNews(all.drawings, cells);
    return all;
}

}  // namespace gnomon
