#include "matrix/cell_worker.h"

#include "matrix/cell_json.h"

namespace gnomon {

std::size_t cellsPerGroup(const MatrixRequest& request) {
    return request.fidelities.size() * request.methods.size() * request.profiles.size();
}

CellChoice cellOf(const MatrixRequest& request, std::size_t index) {
    const std::size_t profiles = request.profiles.size(), methods = request.methods.size();
    return {request.fidelities[index / (methods * profiles)], request.methods[index / profiles % methods],
            request.profiles[index % profiles]};
}

Cell blankCell(const MatrixRequest& request, const CellGroup& group, std::size_t index) {
    const CellChoice choice = cellOf(request, index);
    Cell cell;
    addQuestion(cell, choice.fidelity, request.view);
    cell.device = name(request.device);
    cell.fidelity = name(choice.fidelity.fidelity);
    cell.profile = choice.profile.id, cell.method = methodId(choice.axes), cell.scene = group.scene->id;
    cell.axes = choice.axes;
    cell.effects = request.effects.value_or(Effects::all());
    cell.width = group.size.width, cell.height = group.size.height, cell.frame = group.frame;
    cell.pixels = cell.width * cell.height;
    return cell;
}

CellWorker::CellWorker(const MatrixRequest& request, const std::vector<CellGroup>& groups,
                       Whereabouts& whereabouts)
    : m_request(request), m_groups(groups), m_whereabouts(whereabouts) {}

void CellWorker::enter(const std::string& stage) {
    m_whereabouts.tell(stage);
    if (m_request.atStage) m_request.atStage(m_cell, stage);
}

void CellWorker::begin(std::size_t task) {
    const CellGroup& group = m_groups[task];
    m_cell.clear();
    enter("the frame's set-up");
    if (m_scene != group.scene) {
        m_lab = std::make_unique<Lab>(*group.scene);
        m_scene = group.scene;
        m_lab->drawOn(m_request.device);
        m_lab->onStage([this](const std::string& stage) { enter(stage); });
    }
    m_chosen.clear();
    for (const Profile& profile : m_request.profiles) {
        const auto path = m_lab->path(profile, group.size.width, group.size.height, group.frame);
        m_chosen.push_back(path.back().missing.empty() ? methodId(path.back().axes) : "");
    }
}

std::string CellWorker::step(std::size_t task, std::size_t step) {
    const CellGroup& group = m_groups[task];
    const auto [fidelity, axes, profile] = cellOf(m_request, step);
    if (m_request.atStage) m_cell = blankCell(m_request, group, step).id();
    enter("");
    m_lab->use(fidelity);
    m_lab->simulate(m_request.effects);
    Cell cell = m_lab->run(profile, axes, group.size.width, group.size.height, group.frame);
    cell.chosen = cell.method == m_chosen[step % m_request.profiles.size()];
    addQuestion(cell, fidelity, m_request.view);
    return toJson(cell).dump();
}

}  // namespace gnomon
