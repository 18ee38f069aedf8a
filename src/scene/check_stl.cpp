#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "scene/mesh_check.h"
#include "scene/text.h"

namespace gnomon {
namespace {

constexpr std::size_t kHeader = 84;    // 80 bytes of anything and the number of triangles
constexpr std::size_t kTriangle = 50;  // normal, three vertices, 16 bits of anything

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

std::string lower(std::string_view word) {
    std::string out(word);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
    return out;
}

/// Text files start with "solid", as do some binary ones; those have zero bytes or no facet.
bool isText(std::string_view data) {
    const std::size_t start = data.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || lower(data.substr(start, 5)) != "solid") return false;
    const std::string_view head = data.substr(0, 1024);
    return head.find('\0') == std::string_view::npos;
}

MeshFacts checkText(const std::filesystem::path& file, std::string_view text, const SceneLimits& limits) {
    MeshFacts facts;
    std::vector<std::string_view> words;
    bool inSolid = false, inFacet = false;
    int corners = 0;
    Lines lines(text);
    while (lines.next()) {
        splitWords(lines.line(), words);
        if (words.empty()) continue;
        const std::string key = lower(words[0]);
        if (key == "solid") {
            inSolid = true;
        } else if (key == "facet") {
            if (inFacet) fail(file, lines.number(), "facet inside a facet");
            inFacet = true;
            corners = 0;
        } else if (key == "vertex") {
            if (words.size() < 4)
                fail(file, lines.number(), fmt::format("vertex has {} coordinates, not 3", words.size() - 1));
            for (int k = 1; k <= 3; ++k) {
                const auto value = parseNumber(words[k]);
                if (!value) fail(file, lines.number(), fmt::format("'{}' is no number", printable(words[k])));
                if (const std::string fault = coordinateFault(*value); !fault.empty())
                    fail(file, lines.number(), fault);
            }
            ++corners;
        } else if (key == "endfacet") {
            if (corners != 3) fail(file, lines.number(), fmt::format("facet has {} corners, not 3", corners));
            inFacet = false;
            if (++facts.triangles > limits.triangles)
                fail(file, lines.number(), moreThan(limits.triangles, "triangles"));
        } else if (key == "endsolid") {
            if (inFacet) fail(file, lines.number(), "solid ends inside a facet");
            inSolid = false;
        } else if (key != "outer" && key != "endloop") {
            fail(file, lines.number(), fmt::format("'{}' is no STL keyword", printable(words[0])));
        }
    }
    if (inSolid) fail(file, lines.number(), "file ends inside a solid");
    return facts;
}

}  // namespace

MeshFacts checkStl(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits) {
    std::uint32_t triangles = 0;
    if (data.size() >= kHeader) std::memcpy(&triangles, data.data() + kHeader - 4, 4);
    const std::uint64_t announced = kHeader + std::uint64_t(triangles) * kTriangle;
    if (data.size() < kHeader || data.size() != announced) {
        if (isText(data)) return checkText(file, data, limits);
        if (data.size() < kHeader)
            fail(file, fmt::format("{} bytes are too few for an STL file", data.size()));
        fail(file, fmt::format("announces {} triangles, {} bytes, but has {} bytes", triangles, announced,
                               data.size()));
    }
    if (triangles > limits.triangles)
        fail(file, fmt::format("{} triangles, {}", triangles, moreThan(limits.triangles)));
    for (std::uint32_t t = 0; t < triangles; ++t) {
        float xyz[9];
        std::memcpy(xyz, data.data() + kHeader + t * kTriangle + 12, sizeof xyz);
        for (const float value : xyz)
            if (const std::string fault = coordinateFault(value); !fault.empty())
                fail(file, fmt::format("triangle {}: {}", t, fault));
    }
    return {.triangles = triangles};
}

}  // namespace gnomon
