#include <cstdint>

#include "scene/mesh_check.h"
#include "scene/text.h"

namespace gnomon {
namespace {

/// Joins lines that end in a backslash with what follows them.
std::string_view logicalLine(Lines& lines, std::string& joined) {
    if (!lines.line().ends_with('\\')) return lines.line();
    joined.clear();
    std::string_view part = lines.line();
    while (part.ends_with('\\')) {
        joined += part.substr(0, part.size() - 1);
        joined += ' ';
        if (!lines.next()) return joined;
        part = lines.line();
    }
    joined += part;
    return joined;
}

}  // namespace

MeshFacts checkObj(const std::filesystem::path& file, std::string_view text, const SceneLimits& limits) {
    struct Forward {
        std::int64_t index;
        std::size_t line;
    };
    std::vector<Forward> forwards;  // vertices that were not there yet when a face named them
    std::vector<std::string_view> words;
    std::string joined;
    std::int64_t vertices = 0;
    std::uint64_t parts = 0;  // each is an object to Assimp
    MeshFacts facts;

    Lines lines(text);
    while (lines.next()) {
        const std::size_t number = lines.number();
        const std::string_view line = logicalLine(lines, joined);
        splitWords(line.substr(0, line.find('#')), words);
        if (words.empty()) continue;

        if (words[0] == "v") {
            if (words.size() < 4)
                fail(file, number, fmt::format("vertex has {} coordinates, not 3", words.size() - 1));
            for (int k = 1; k <= 3; ++k) {
                const auto value = parseNumber(words[k]);
                if (!value) fail(file, number, fmt::format("'{}' is no number", printable(words[k])));
                if (const std::string fault = coordinateFault(*value); !fault.empty())
                    fail(file, number, fault);
            }
            ++vertices;
        } else if (words[0] == "f") {
            const std::size_t corners = words.size() - 1;
            if (corners < 3)
                fail(
                    file, number,
                    fmt::format("face has {} corner{}, at least 3 needed", corners, corners == 1 ? "" : "s"));
            for (std::size_t k = 1; k < words.size(); ++k) {
                const auto index = parseInteger<std::int64_t>(words[k].substr(0, words[k].find('/')));
                if (!index) fail(file, number, fmt::format("'{}' is no face corner", printable(words[k])));
                if (*index == 0) fail(file, number, "face index 0; they start at 1");
                if (*index < -vertices)
                    fail(file, number,
                         fmt::format("face index {} is out of range, {} vertices so far", *index, vertices));
                if (*index > vertices) forwards.push_back({*index, number});
            }
            facts.triangles += corners - 2;
        } else if (words[0] == "l" || words[0] == "p") {
            ++facts.otherPrimitives;
        } else if (words[0] == "o" || words[0] == "g" || words[0] == "usemtl") {
            if (++parts > limits.objects)
                fail(file, number, moreThan(limits.objects, "objects, groups and changes of material"));
        }
        if (facts.triangles + facts.otherPrimitives > limits.triangles)
            fail(file, number, moreThan(limits.triangles, "triangles"));
    }
    for (const Forward& forward : forwards)
        if (forward.index > vertices)
            fail(file, forward.line,
                 fmt::format("face index {} is out of range, {} vertices in the file", forward.index,
                             vertices));
    return facts;
}

}  // namespace gnomon
