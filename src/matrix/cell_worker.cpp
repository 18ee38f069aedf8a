#include "matrix/cell_worker.h"

#include <stdexcept>

#include "matrix/cell_json.h"
#include "matrix/cell_pictures.h"

namespace gnomon {

CellWorker::CellWorker(const CellList& list, const std::vector<CellTask>& tasks, Whereabouts& whereabouts)
    : m_list(list), m_request(list.request()), m_tasks(tasks), m_whereabouts(whereabouts) {}

void CellWorker::enter(const std::string& stage) {
    m_whereabouts.tell(stage);
    // The cells of a frame share it: each would be stopped there.
    if (stage == kTruthStage && stage == m_avoided)
        throw std::runtime_error("not drawn: two cells of this frame were stopped in its truth");
    if (m_request.atStage) m_request.atStage(m_cell, stage);
}

void CellWorker::begin(std::size_t task) {
    const CellGroup& group = m_list.groups()[m_tasks[task].group];
    m_cell.clear();
    enter("the frame's set-up");
    if (m_scene != group.scene) {
        m_lab = std::make_unique<Lab>(*group.scene);
        m_scene = group.scene;
        m_lab->drawOn(m_request.device);
        m_lab->onStage([this](const std::string& stage) { enter(stage); });
        if (!m_request.pictureFolder.empty())
            m_lab->onDrawn([this](const Cell& cell, const Pictures& pictures) {
                enter("its pictures");
                writePictures(m_request.pictureFolder, cell.digest, pictures);
            });
    }
    m_chosen.clear();
    for (const Profile& profile : m_request.profiles) {
        const auto path = m_lab->path(profile, group.size.width, group.size.height, group.frame);
        m_chosen.push_back(path.back().missing.empty() ? methodId(path.back().axes) : "");
    }
}

std::string CellWorker::step(std::size_t task, std::size_t step) {
    const std::size_t place = m_tasks[task].places[step];
    const CellGroup& group = m_list.groupOf(place);
    const auto [fidelity, axes, profile] = m_list.choiceOf(place);
    if (m_request.atStage) m_cell = m_list.blank(place).id();
    enter("");
    m_lab->use(fidelity);
    m_lab->simulate(m_request.effects);
    Cell cell = m_lab->run(profile, axes, group.size.width, group.size.height, group.frame);
    cell.chosen = cell.method == m_chosen[m_list.profileOf(place)];
    addQuestion(cell, fidelity, m_request.view);
    return toJson(cell).dump();
}

}  // namespace gnomon
