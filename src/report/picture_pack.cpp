#include "report/picture_pack.h"

#include <array>
#include <cassert>

#include "report/deflate.h"

namespace gnomon {
namespace {

std::vector<std::uint8_t> planesOf(const Image& image) {
    const auto channels = std::size_t(image.channels);
    const std::size_t pixels = image.data.size() / channels;
    std::vector<std::uint8_t> planes(image.data.size());
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < pixels; ++i) planes[c * pixels + i] = image.data[i * channels + c];
    return planes;
}

/// FNV-1a, 64 bits.
std::uint64_t hashOf(const PackedPicture& p, const std::vector<std::uint8_t>& bytes) {
    std::uint64_t hash = 14695981039346656037ull;
    const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 1099511628211ull; };
    for (const int n : {p.width, p.height, p.planes, int(p.kind)}) add(std::uint64_t(n));
    for (const std::uint8_t byte : bytes) add(byte);
    return hash;
}

/// Each byte less its left neighbour.
std::vector<std::uint8_t> rowDifferences(const std::vector<std::uint8_t>& bytes, int width) {
    std::vector<std::uint8_t> out(bytes.size());
    for (std::size_t row = 0; row < bytes.size(); row += std::size_t(width)) {
        out[row] = bytes[row];
        for (std::size_t i = row + 1; i < row + std::size_t(width); ++i)
            out[i] = std::uint8_t(bytes[i] - bytes[i - 1]);
    }
    return out;
}

std::vector<std::uint8_t> combined(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    std::vector<std::uint8_t> out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] ^ b[i];
    return out;
}

/// How much there is to say about @p bytes: where they change from one to the next.
std::size_t changesIn(const std::vector<std::uint8_t>& bytes) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < bytes.size(); ++i) changes += bytes[i] != bytes[i - 1];
    return changes;
}

}  // namespace

const std::string& name(PictureKind kind) {
    static const std::array<std::string, 4> names{"rgb", "grey", "count", "cause"};
    return names[std::size_t(kind)];
}

int PicturePack::beginChunk() {
    finish();
    m_chunks.emplace_back();
    return int(m_chunks.size()) - 1;
}

void PicturePack::finish() {
    if (!m_chunks.empty()) m_chunks.back() = {deflated(m_chunk), m_chunk.size()};
    m_chunk.clear();
}

int PicturePack::add(const Image& image, PictureKind kind, const std::vector<int>& like, int mostSteps) {
    assert(!m_chunks.empty());
    PackedPicture picture{.chunk = int(m_chunks.size()) - 1,
                          .offset = m_chunk.size(),
                          .width = image.width,
                          .height = image.height,
                          .planes = image.channels,
                          .kind = kind};
    std::vector<std::uint8_t> bytes = planesOf(image);
    const std::uint64_t hash = hashOf(picture, bytes);
    for (auto [at, end] = m_byHash.equal_range(hash); at != end; ++at) {
        const PackedPicture& other = m_pictures[std::size_t(at->second)];
        const bool isSame = other.width == picture.width && other.height == picture.height &&
                            other.kind == kind && m_held.at(at->second).bytes == bytes;
        if (isSame) return at->second;
    }

    std::vector<std::uint8_t> least = rowDifferences(bytes, image.width);
    std::size_t fewest = changesIn(least);
    int steps = 0;
    for (const int candidate : like) {
        const PackedPicture& other = m_pictures[std::size_t(candidate)];
        const auto at = m_held.find(candidate);
        if (at == m_held.end()) continue;
        const Held& held = at->second;
        if (held.steps >= mostSteps || other.width != picture.width || other.height != picture.height ||
            other.planes != picture.planes)
            continue;
        std::vector<std::uint8_t> rest = combined(bytes, held.bytes);
        const std::size_t changes = changesIn(rest);
        if (changes >= fewest) continue;
        fewest = changes, least = std::move(rest);
        picture.base = candidate, steps = held.steps + 1;
    }
    m_chunk.append(reinterpret_cast<const char*>(least.data()), least.size());
    const int index = size();
    m_pictures.push_back(picture);
    m_held.emplace(index, Held{std::move(bytes), steps});
    m_byHash.emplace(hash, index);
    return index;
}

void PicturePack::dropBytes(const std::vector<int>& pictures) {
    for (const int picture : pictures) m_held.erase(picture);
    std::erase_if(m_byHash, [&](const auto& entry) { return !m_held.contains(entry.second); });
}

}  // namespace gnomon
