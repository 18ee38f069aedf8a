#pragma once

#include <zlib.h>

#include <string>
#include <vector>

#include "image/image.h"
#include "report/picture_pack.h"

namespace gnomon {

/// The bytes of a raw DEFLATE stream; "broken" if it isn't one of @p length bytes.
inline std::string inflated(const std::string& stream, std::size_t length) {
    std::string bytes(length + 1, '\0');  // one more, so that a longer one is seen
    z_stream z{};
    inflateInit2(&z, -15);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stream.data()));
    z.avail_in = uInt(stream.size());
    z.next_out = reinterpret_cast<Bytef*>(bytes.data());
    z.avail_out = uInt(bytes.size());
    const int end = inflate(&z, Z_FINISH);
    const bool isRight = end == Z_STREAM_END && z.total_out == length && z.avail_in == 0;
    inflateEnd(&z);
    bytes.resize(length);
    return isRight ? bytes : "broken";
}

/// A packed picture, read as the report's page is to read it.
inline Image unpacked(const std::vector<PackedPicture>& pictures, const std::vector<PackedChunk>& chunks,
                      int index) {
    const PackedPicture& p = pictures.at(std::size_t(index));
    const PackedChunk& chunk = chunks.at(std::size_t(p.chunk));
    const auto plane = std::size_t(p.width) * std::size_t(p.height), size = plane * std::size_t(p.planes);
    const std::string bytes = inflated(chunk.deflated, chunk.length).substr(p.offset, size);
    Image image{p.width, p.height, p.planes, std::vector<std::uint8_t>(size)};
    const Image base = p.base < 0 ? Image{} : unpacked(pictures, chunks, p.base);
    for (std::size_t c = 0; c < std::size_t(p.planes); ++c)
        for (std::size_t i = 0; i < plane; ++i) {
            const std::size_t to = i * std::size_t(p.planes) + c;
            std::uint8_t value = std::uint8_t(bytes.at(c * plane + i));
            if (p.base >= 0)
                value = std::uint8_t(value ^ base.data.at(to));
            else if (i % std::size_t(p.width) > 0)
                value = std::uint8_t(value + image.data[to - std::size_t(p.planes)]);
            image.data[to] = value;
        }
    return image;
}

}  // namespace gnomon
