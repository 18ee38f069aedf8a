#include "matrix/cell_list.h"

namespace gnomon {

CellList::CellList(const MatrixRequest& request) : m_request(&request) {
    for (const Scene& scene : request.scenes)
        for (const Size& size : request.sizes)
            for (const int frame : framesOf(request, scene)) m_groups.push_back({&scene, size, frame});
    m_perGroup = request.fidelities.size() * request.methods.size() * request.profiles.size();
}

CellChoice CellList::choiceOf(std::size_t place) const {
    const std::size_t profiles = m_request->profiles.size(), methods = m_request->methods.size();
    const std::size_t index = place % m_perGroup;
    return {m_request->fidelities[index / (methods * profiles)],
            m_request->methods[index / profiles % methods], m_request->profiles[index % profiles]};
}

Cell CellList::blank(std::size_t place) const {
    const CellChoice choice = choiceOf(place);
    const CellGroup& group = groupOf(place);
    Cell cell;
    addQuestion(cell, choice.fidelity, m_request->view);
    cell.device = name(m_request->device);
    cell.fidelity = name(choice.fidelity.fidelity);
    cell.profile = choice.profile.id, cell.method = methodId(choice.axes), cell.scene = group.scene->id;
    cell.axes = choice.axes;
    cell.effects = m_request->effects.value_or(Effects::all());
    cell.width = group.size.width, cell.height = group.size.height, cell.frame = group.frame;
    cell.pixels = cell.width * cell.height;
    return cell;
}

}  // namespace gnomon
