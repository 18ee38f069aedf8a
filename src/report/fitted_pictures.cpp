// Which pictures of a run are kept where a report may not hold all.

#include <algorithm>
#include <utility>

#include "report/run_pictures.h"

namespace gnomon {
namespace {

/// What is kept of a run's pictures.
class Keeper {
  public:
    explicit Keeper(RunPictures& all) : m_all(all), m_gone(all.drawings.size()) {}

    void dropStrip(std::size_t drawing) {
        m_all.drawings[drawing].strip.clear();
        m_all.drawings[drawing].stripChunk = -1;
    }
    /// What is said of a drawing that differs from its run is kept.
    void drop(std::size_t drawing) {
        dropStrip(drawing);
        if (m_all.drawings[drawing].differs.empty())
            m_gone[drawing] = true;
        else
            m_all.drawings[drawing].pictures.clear();
    }

    /// Bytes of the chunks that are still needed.
    std::size_t bytes() {
        mark();
        std::size_t sum = 0;
        for (std::size_t c = 0; c < m_chunks.size(); ++c)
            sum += m_chunks[c] ? m_all.chunks[c].deflated.size() : 0;
        return sum;
    }

    /// Takes out what is no longer needed.
    RunPictures result() {
        mark();
        RunPictures kept;
        kept.refusedPlans = std::move(m_all.refusedPlans);
        std::vector<int> newChunk(m_chunks.size(), -1), newPicture(m_pictures.size(), -1);
        for (std::size_t c = 0; c < m_chunks.size(); ++c) {
            if (!m_chunks[c]) continue;
            newChunk[c] = int(kept.chunks.size());
            kept.chunks.push_back(std::move(m_all.chunks[c]));
        }
        for (std::size_t p = 0; p < m_pictures.size(); ++p) {
            if (!m_pictures[p]) continue;
            newPicture[p] = int(kept.pictures.size());
            PackedPicture picture = m_all.pictures[p];
            picture.chunk = newChunk[std::size_t(picture.chunk)];
            if (picture.base >= 0) picture.base = newPicture[std::size_t(picture.base)];
            kept.pictures.push_back(picture);
        }
        for (std::size_t d = 0; d < m_gone.size(); ++d) {
            if (m_gone[d]) continue;
            CellDrawing drawing = std::move(m_all.drawings[d]);
            if (drawing.pictures.empty()) {
                kept.drawings.push_back(std::move(drawing));
                continue;
            }
            // A drawing whose pictures all stand elsewhere has no chunk of its own left.
            const auto firstOf = [&](int picture) {
                return kept.pictures[std::size_t(newPicture[std::size_t(picture)])].chunk;
            };
            const int own = newChunk[std::size_t(drawing.chunk)];
            drawing.chunk = own >= 0 ? own : firstOf(drawing.pictures.front().second);
            if (drawing.stripChunk >= 0) drawing.stripChunk = newChunk[std::size_t(drawing.stripChunk)];
            for (auto& picture : drawing.pictures) picture.second = newPicture[std::size_t(picture.second)];
            for (StripFrame& frame : drawing.strip)
                for (auto& buffer : frame.buffers) buffer.second = newPicture[std::size_t(buffer.second)];
            kept.drawings.push_back(std::move(drawing));
        }
        return kept;
    }

  private:
    void mark() {
        m_pictures.assign(m_all.pictures.size(), false);
        m_chunks.assign(m_all.chunks.size(), false);
        const auto need = [&](int picture) {
            for (; picture >= 0; picture = m_all.pictures[std::size_t(picture)].base) {
                m_pictures[std::size_t(picture)] = true;
                m_chunks[std::size_t(m_all.pictures[std::size_t(picture)].chunk)] = true;
            }
        };
        for (std::size_t d = 0; d < m_gone.size(); ++d) {
            if (m_gone[d]) continue;
            for (const auto& picture : m_all.drawings[d].pictures) need(picture.second);
            for (const StripFrame& frame : m_all.drawings[d].strip)
                for (const auto& buffer : frame.buffers) need(buffer.second);
        }
    }

    RunPictures& m_all;
    std::vector<bool> m_gone{}, m_pictures{}, m_chunks{};
};

}  // namespace

RunPictures fitted(RunPictures all, std::size_t bytes) {
    std::vector<std::size_t> order(all.drawings.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = order.size() - 1 - i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return all.drawings[a].news > all.drawings[b].news;
    });
    Keeper keeper(all);
    std::size_t size = keeper.bytes();
    for (std::size_t i = 0; i < order.size() && size > bytes; ++i)
        keeper.dropStrip(order[i]), size = keeper.bytes();
    for (std::size_t i = 0; i < order.size() && size > bytes; ++i)
        if (!all.drawings[order[i]].pictures.empty()) keeper.drop(order[i]), size = keeper.bytes();
    return keeper.result();
}

}  // namespace gnomon
