#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "scene/mesh_check.h"
#include "scene/text.h"

namespace gnomon {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::optional<Type> typeOf(std::string_view word) {
    struct Name {
        std::string_view name, alias;
        Type type;
    };
    constexpr Name kNames[] = {
        {"char", "int8", Type::Int8},        {"uchar", "uint8", Type::Uint8},
        {"short", "int16", Type::Int16},     {"ushort", "uint16", Type::Uint16},
        {"int", "int32", Type::Int32},       {"uint", "uint32", Type::Uint32},
        {"float", "float32", Type::Float32}, {"double", "float64", Type::Float64},
    };
    for (const Name& entry : kNames)
        if (word == entry.name || word == entry.alias) return entry.type;
    return {};
}

std::size_t sizeOf(Type type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[std::size_t(type)];
}

bool isFloat(Type type) {
    return type >= Type::Float32;
}

struct Property {
    std::string name{};
    Type type = Type::Float32;
    std::optional<Type> countType{};  ///< of a list
};

struct Element {
    std::string name{};
    std::size_t line = 0;
    std::uint64_t count = 0;
    std::vector<Property> properties{};
};

enum class Format { Text, LittleEndian, BigEndian };

struct Header {
    Format format = Format::Text;
    std::vector<Element> elements{};
    std::string_view data{};
    std::size_t lines = 0;  ///< of the header
};

Header parseHeader(const std::filesystem::path& file, std::string_view all) {
    Header header;
    std::vector<std::string_view> words;
    bool formatKnown = false;
    Lines lines(all);
    if (!lines.next() || lines.line() != "ply") fail(file, 1, "no PLY file, its first line isn't \"ply\"");
    while (lines.next()) {
        const std::size_t number = lines.number();
        splitWords(lines.line(), words);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") {
            if (!formatKnown) fail(file, number, "the header names no format");
            header.data = lines.rest();
            header.lines = number;
            return header;
        }
        if (words[0] == "format" && words.size() >= 2) {
            if (words[1] == "ascii") {
                header.format = Format::Text;
            } else if (words[1] == "binary_little_endian") {
                header.format = Format::LittleEndian;
            } else if (words[1] == "binary_big_endian") {
                header.format = Format::BigEndian;
            } else {
                fail(file, number, fmt::format("unknown format '{}'", printable(words[1])));
            }
            formatKnown = true;
        } else if (words[0] == "element" && words.size() == 3) {
            const auto count = parseInteger<std::uint64_t>(words[2]);
            if (!count) fail(file, number, fmt::format("'{}' is no number of elements", printable(words[2])));
            header.elements.push_back(
                {.name = std::string(words[1]), .line = number, .count = *count, .properties = {}});
        } else if (words[0] == "property" && !header.elements.empty()) {
            const bool list = words.size() == 5 && words[1] == "list";
            const auto type = words.size() < 3 ? std::nullopt : typeOf(words[words.size() - 2]);
            const auto countType = list ? typeOf(words[2]) : std::nullopt;
            if (!type || (list && (!countType || isFloat(*countType))) || (!list && words.size() != 3))
                fail(file, number, fmt::format("bad property '{}'", printable(lines.line())));
            header.elements.back().properties.push_back(
                {.name = std::string(words.back()), .type = *type, .countType = countType});
        } else {
            fail(file, number, fmt::format("bad header line '{}'", printable(lines.line())));
        }
    }
    fail(file, lines.number(), "the header has no end_header");
}

/// Values one after the other, from text or bytes.
class Reader {
  public:
    Reader(const std::filesystem::path& file, const Header& header)
        : m_file(file),
          m_format(header.format),
          m_data(header.data),
          m_lines(header.data),
          m_line(header.lines) {}

    void startRow(const Element& element, std::uint64_t row) {
        m_element = &element;
        m_row = row;
        if (m_format != Format::Text) return;
        m_word = 0;
        do {
            if (!m_lines.next()) stop("the file ends here");
            splitWords(m_lines.line(), m_words);
        } while (m_words.empty());
    }

    double next(Type type) {
        if (m_format != Format::Text) return nextBinary(type);
        if (m_word == m_words.size()) stop("too few values");
        const std::string_view word = m_words[m_word++];
        const auto value = parseNumber(word);
        if (!value) stop(fmt::format("'{}' is no number", printable(word)));
        if (!isFloat(type) && *value != std::floor(*value))
            stop(fmt::format("{} is no whole number", *value));
        return *value;
    }

    [[noreturn]] void stop(std::string_view what) const {
        const std::string where = fmt::format("{} {}: {}", printable(m_element->name), m_row, what);
        if (m_format == Format::Text) fail(m_file, m_line + m_lines.number(), where);
        fail(m_file, where);
    }

  private:
    template <typename T>
    static double valueOf(const char* bytes) {
        T value;
        std::memcpy(&value, bytes, sizeof value);
        return double(value);
    }

    double nextBinary(Type type) {
        const std::size_t size = sizeOf(type);
        if (m_data.size() < size) stop("the file ends here");
        char bytes[8];
        std::memcpy(bytes, m_data.data(), size);
        m_data.remove_prefix(size);
        const auto native =
            std::endian::native == std::endian::little ? Format::LittleEndian : Format::BigEndian;
        if (m_format != native) std::reverse(bytes, bytes + size);
        switch (type) {
            case Type::Int8:
                return valueOf<std::int8_t>(bytes);
            case Type::Uint8:
                return valueOf<std::uint8_t>(bytes);
            case Type::Int16:
                return valueOf<std::int16_t>(bytes);
            case Type::Uint16:
                return valueOf<std::uint16_t>(bytes);
            case Type::Int32:
                return valueOf<std::int32_t>(bytes);
            case Type::Uint32:
                return valueOf<std::uint32_t>(bytes);
            case Type::Float32:
                return valueOf<float>(bytes);
            case Type::Float64:
                return valueOf<double>(bytes);
        }
        return 0;
    }

    const std::filesystem::path& m_file;
    Format m_format;
    std::string_view m_data;
    Lines m_lines;
    std::size_t m_line;
    std::vector<std::string_view> m_words{};
    std::size_t m_word = 0;
    const Element* m_element = nullptr;
    std::uint64_t m_row = 0;
};

bool isFaceList(const Element& element, const Property& property) {
    return element.name == "face" && property.countType &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool isCoordinate(const Element& element, const Property& property) {
    return element.name == "vertex" && !property.countType &&
           (property.name == "x" || property.name == "y" || property.name == "z");
}

}  // namespace

MeshFacts checkPly(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits) {
    const Header header = parseHeader(file, data);
    const auto element = [&](std::string_view name) -> const Element& {
        const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                        [&](const Element& e) { return e.name == name; });
        if (found == header.elements.end())
            fail(file, fmt::format("the header announces no element '{}'", name));
        return *found;
    };
    const Element &vertex = element("vertex"), &face = element("face");
    if (std::count_if(vertex.properties.begin(), vertex.properties.end(),
                      [&](const Property& p) { return isCoordinate(vertex, p); }) != 3)
        fail(file, vertex.line, "vertices without x, y and z");
    const auto indices = std::find_if(face.properties.begin(), face.properties.end(),
                                      [&](const Property& p) { return isFaceList(face, p); });
    if (indices == face.properties.end() || isFloat(indices->type))
        fail(file, face.line, "faces without a list of vertex indices");

    MeshFacts facts;
    Reader reader(file, header);
    for (const Element& e : header.elements) {
        // Each row takes a byte at least: a count beyond that is refused before anything is done so often.
        if (e.properties.empty()) fail(file, e.line, "element without a property");
        if (e.count > header.data.size())
            fail(
                file, e.line,
                fmt::format("announces {} of '{}', more than the file can hold", e.count, printable(e.name)));
        if (const std::uint64_t most = 3 * limits.triangles; e.count > most)
            fail(file, e.line,
                 fmt::format("announces {} of '{}', {}", e.count, printable(e.name), moreThan(most)));
        for (std::uint64_t row = 0; row < e.count; ++row) {
            reader.startRow(e, row);
            for (const Property& property : e.properties) {
                const double count = property.countType ? reader.next(*property.countType) : 1;
                if (count < 0) reader.stop(fmt::format("a list of {} values", count));
                const bool isFace = isFaceList(e, property);
                if (isFace && count < 3) reader.stop(fmt::format("has {} corners, at least 3 needed", count));
                for (double k = 0; k < count; ++k) {
                    const double value = reader.next(property.type);
                    if (isFace && !(value >= 0 && value < double(vertex.count)))
                        reader.stop(
                            fmt::format("index {} is out of range, {} vertices", value, vertex.count));
                    if (!isCoordinate(e, property)) continue;
                    if (const std::string fault = coordinateFault(value); !fault.empty()) reader.stop(fault);
                }
                if (!isFace) continue;
                facts.triangles += std::size_t(count) - 2;
                if (facts.triangles > limits.triangles) reader.stop(moreThan(limits.triangles, "triangles"));
            }
        }
    }
    return facts;
}

}  // namespace gnomon
