#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/image.h"

namespace gnomon {

/// What the bytes of a picture mean.
enum class PictureKind {
    Rgb,
    Grey,   ///< 0 to 255
    Count,  ///< small numbers that count something
    Cause   ///< 0, or one more than an index into a list of causes
};
const std::string& name(PictureKind);  ///< "rgb", "grey", "count", "cause"

/// Where a picture's bytes lie, and what they are: plane after plane, rows from the top.
///
/// Without a base each byte is the difference to its left neighbour, modulo 256. With one the bytes are to be
/// combined with those of that picture by exclusive or; at most two such steps lead to a picture without.
struct PackedPicture {
    int chunk = 0;
    std::size_t offset = 0;  ///< in the chunk, bytes
    int width = 0, height = 0, planes = 1;
    PictureKind kind = PictureKind::Grey;
    int base = -1;  ///< index of another picture of the same size and planes
};

/// Pictures that are inflated together.
struct PackedChunk {
    std::string deflated{};  ///< deflated() in deflate.h
    std::size_t length = 0;  ///< before that, bytes
};

/// Pictures in few bytes: of equal ones one is kept, and of alike ones the difference.
class PicturePack {
  public:
    /// Begins a chunk into which further pictures go, and deflates the last one.
    int beginChunk();

    /// Deflates the last chunk. Then nothing more can be added.
    void finish();

    /// Adds a picture to the last chunk, unless it stands somewhere already.
    /// @param like       pictures that it may look like: the one that leaves the least becomes its base, if
    /// that
    ///                   is less than the picture itself; those whose bytes were dropped are passed over
    /// @param mostSteps  to a picture without a base, at most 2; with 1 others can build on this one
    /// @return its index
    int add(const Image& image, PictureKind kind, const std::vector<int>& like = {}, int mostSteps = 2);

    /// Forgets the bytes of pictures: nothing that comes later is found equal to them. They stay in their
    /// chunks.
    void dropBytes(const std::vector<int>& pictures);

    int size() const { return int(m_pictures.size()); }
    const std::vector<PackedPicture>& pictures() const { return m_pictures; }
    /// @pre finish() has been called
    const std::vector<PackedChunk>& chunks() const { return m_chunks; }

  private:
    /// What is known of a picture whose bytes are still held.
    struct Held {
        std::vector<std::uint8_t> bytes{};  ///< plane after plane
        int steps = 0;                      ///< bases below it
    };
    std::vector<PackedPicture> m_pictures{};
    std::vector<PackedChunk> m_chunks{};
    std::string m_chunk{};  ///< the bytes of the last one
    std::map<int, Held> m_held{};
    std::multimap<std::uint64_t, int> m_byHash{};
};

}  // namespace gnomon
