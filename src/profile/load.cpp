// A field of the table fields() is one key of the file: how to read it, and into what. Nothing else knows the
// keys.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "profile/check.h"
#include "profile/profile.h"
#include "profile/words.h"
#include "text/deep_key.h"
#include "text/one_line.h"

namespace gnomon {
namespace {

/// Beyond it a file is no profile: the longest has five kilobytes.
constexpr std::uint64_t kMostBytes = 262'144;

/// A key or a file's name may have any character.
[[noreturn]] void fail(const std::string& what) {
    throw ProfileError(oneLine(what));
}

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& what) {
    fail(fmt::format("{}:{}: {}", file, line, what));
}

std::size_t lineOf(const toml::node& node) {
    return node.source().begin.line;
}

/// One value of the file, with what an error message about it needs.
struct Value {
    const std::string& file;
    const std::string& key;
    const toml::node& node;
    bool sourced = false;  ///< its fact has a source, so that "nothing" says something

    [[noreturn]] void refuse(const std::string& what) const { fail(file, lineOf(node), what); }

    template <class T>
    T as(const char* type) const {
        const std::optional<T> value = node.value_exact<T>();
        if (!value) refuse(fmt::format("{} must be {}", key, type));
        return *value;
    }

    bool yesOrNo() const { return as<bool>("true or false"); }
    std::string text() const {
        const auto value = as<std::string>("a string");
        if (!isOneLine(value)) refuse(fmt::format("{} must be one line", key));
        return value;
    }

    std::int64_t whole(std::int64_t least, std::int64_t most) const {
        const auto value = as<std::int64_t>("a whole number");
        if (value < least || value > most)
            refuse(fmt::format("{} = {} is outside {} to {}", key, value, least, most));
        return value;
    }

    static constexpr double kLeastRate = 0.001;

    /// A rate, whole or not, or 0: none; written so that "nan" is refused as well.
    double rate(double most) const {
        const double value =
            node.is_integer() ? static_cast<double>(as<std::int64_t>("")) : as<double>("a number");
        if (!(value == 0 || (value >= kLeastRate && value <= most)))
            refuse(fmt::format("{} = {} is neither 0 nor {} to {}", key, value, kLeastRate, most));
        return value;
    }

    template <class Word>
    Word word(std::string_view spelling) const {
        if (const auto found = fromName<Word>(spelling)) return *found;
        refuse(fmt::format("unknown word \"{}\" in {} (known: {})", spelling, key,
                           fmt::join(names<Word>(), ", ")));
    }

    BlendPair pair() const {
        const std::string words = text();
        const auto space = words.find(' ');
        if (space == std::string::npos)
            refuse(fmt::format("\"{}\" in {} must be two blend factors, \"source destination\"", words, key));
        return {word<BlendFactor>(words.substr(0, space)), word<BlendFactor>(words.substr(space + 1))};
    }

    ColourFormat colourFormat() const {
        const std::string format = text();
        const auto known = knownColourFormats();
        for (const ColourFormat& candidate : known)
            if (candidate.name == format) return candidate;
        std::vector<std::string> spellings;
        for (const ColourFormat& candidate : known) spellings.push_back(candidate.name);
        refuse(fmt::format("unknown word \"{}\" in {} (known: {})", format, key, fmt::join(spellings, ", ")));
    }

    /// The elements of an array, each read by @p read; none may be there twice.
    template <class Read>
    auto list(Read read) const {
        const toml::array* array = node.as_array();
        if (!array) refuse(fmt::format("{} must be an array", key));
        if (array->empty() && !sourced)
            refuse(fmt::format("{} is empty: leave it out if the chip has none, or say where that is from",
                               key));

        std::vector<decltype(read(*this))> elements;
        std::set<std::string> seen;
        for (const toml::node& item : *array) {
            const Value element{file, key, item};
            elements.push_back(read(element));
            if (const std::string spelling = element.written(); !seen.insert(spelling).second)
                element.refuse(fmt::format("{} has {} twice", key, spelling));
        }
        return elements;
    }

    /// The value for people: without quotes and brackets.
    std::string written() const {
        if (const auto* array = node.as_array()) {
            std::vector<std::string> elements;
            for (const toml::node& item : *array) elements.push_back(Value{file, key, item}.written());
            if (elements.empty()) return "none";
            return fmt::format("{}", fmt::join(elements, ", "));
        }
        if (const auto string = node.value_exact<std::string>()) return *string;
        if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
        if (const auto real = node.value_exact<double>()) return fmt::format("{}", *real);
        return node.value_exact<bool>().value_or(false) ? "true" : "false";
    }
};

using Read = std::function<void(Profile&, const Value&)>;

Read yesOrNo(bool Profile::*field) {
    return [=](Profile& profile, const Value& value) { profile.*field = value.yesOrNo(); };
}

template <class Number>
Read whole(Number Profile::*field, Number most) {
    return [=](Profile& profile, const Value& value) {
        profile.*field = static_cast<Number>(value.whole(0, most));
    };
}

Read rate(double Profile::*field, double most) {
    return [=](Profile& profile, const Value& value) { profile.*field = value.rate(most); };
}

template <class Word>
Read word(Word Profile::*field) {
    return [=](Profile& profile, const Value& value) { profile.*field = value.word<Word>(value.text()); };
}

template <class Word>
Read words(std::set<Word> Profile::*field) {
    return [=](Profile& profile, const Value& value) {
        const auto all = value.list([](const Value& element) { return element.word<Word>(element.text()); });
        profile.*field = {all.begin(), all.end()};
    };
}

template <class Word>
Read wordsInOrder(std::vector<Word> Profile::*field) {
    return [=](Profile& profile, const Value& value) {
        profile.*field = value.list([](const Value& element) { return element.word<Word>(element.text()); });
    };
}

Read pairs(std::set<BlendPair> Profile::*field) {
    return [=](Profile& profile, const Value& value) {
        const auto all = value.list([](const Value& element) { return element.pair(); });
        profile.*field = {all.begin(), all.end()};
    };
}

void readColourFormats(Profile& profile, const Value& value) {
    profile.colourFormats = value.list([](const Value& element) { return element.colourFormat(); });
}

void readDepthBits(Profile& profile, const Value& value) {
    profile.depthBits =
        value.list([](const Value& element) { return static_cast<int>(element.whole(1, 32)); });
    profile.depth = !profile.depthBits.empty();
}

struct Field {
    std::string_view key;
    Read read;
};

// The greatest numbers are not those of any chip: they only catch slips such as bytes for megabytes.
const std::vector<Field>& fields() {
    static const std::vector<Field> kFields{
        {"colour_formats", readColourFormats},
        {"alpha_bits", whole(&Profile::alphaBits, 16)},
        {"alpha_excludes_depth", yesOrNo(&Profile::alphaExcludesDepth)},
        {"blend_writes_alpha", yesOrNo(&Profile::blendWritesAlpha)},
        {"write_mask", word(&Profile::writeMask)},
        {"depth_bits", readDepthBits},
        {"depth_encodings", wordsInOrder(&Profile::depthEncodings)},
        {"depth_functions", words(&Profile::depthFunctions)},
        {"alpha_functions", words(&Profile::alphaFunctions)},
        {"stencil_bits", whole(&Profile::stencilBits, 8)},
        {"stencil_wrap", yesOrNo(&Profile::stencilWrap)},
        {"two_sided_stencil", yesOrNo(&Profile::twoSidedStencil)},
        {"source_factors", words(&Profile::sourceFactors)},
        {"destination_factors", words(&Profile::destinationFactors)},
        {"blend_pairs", pairs(&Profile::blendPairs)},
        {"constant_source_pairs", pairs(&Profile::constantSourcePairs)},
        {"alpha_source_factors", words(&Profile::alphaSourceFactors)},
        {"alpha_destination_factors", words(&Profile::alphaDestinationFactors)},
        {"separate_alpha_factors", yesOrNo(&Profile::separateAlphaFactors)},
        {"blend_equations", words(&Profile::blendEquations)},
        {"logic_ops", yesOrNo(&Profile::logicOps)},
        {"blend_units", wordsInOrder(&Profile::blendUnits)},
        {"dither_modes", wordsInOrder(&Profile::ditherModes)},
        {"texture_units", whole(&Profile::textureUnits, 32)},
        {"max_texture_size", whole(&Profile::maxTextureSize, 65536)},
        {"max_texture_aspect", whole(&Profile::maxTextureAspect, 65536)},
        {"texture_non_power_of_two", yesOrNo(&Profile::textureNonPowerOfTwo)},
        {"frame_texture", word(&Profile::frameTexture)},
        {"culling", yesOrNo(&Profile::culling)},
        {"polygon_offset_units", yesOrNo(&Profile::polygonOffsetUnits)},
        {"polygon_offset_factor", yesOrNo(&Profile::polygonOffsetFactor)},
        {"clip_planes", whole(&Profile::clipPlanes, 32)},
        {"shaders", yesOrNo(&Profile::shaders)},
        {"geometry_shaders", yesOrNo(&Profile::geometryShaders)},
        {"atomic_counters", yesOrNo(&Profile::atomicCounters)},
        {"framebuffer_fetch", yesOrNo(&Profile::framebufferFetch)},
        {"depth_clamp", yesOrNo(&Profile::depthClamp)},
        {"depth_textures", yesOrNo(&Profile::depthTextures)},
        {"max_width", whole(&Profile::maxWidth, 65536)},
        {"max_height", whole(&Profile::maxHeight, 65536)},
        {"frame_bytes", whole(&Profile::frameBytes, std::int64_t{1} << 40)},
        {"megapixels_per_second", rate(&Profile::megapixelsPerSecond, 1e6)},
        {"megatriangles_per_second", rate(&Profile::megatrianglesPerSecond, 1e6)},
        {"gigabytes_per_second", rate(&Profile::gigabytesPerSecond, 1e5)},
        {"on_chip_frame", yesOrNo(&Profile::onChipFrame)},
        {"bus_megabytes_per_second", rate(&Profile::busMegabytesPerSecond, 1e6)},
    };
    return kFields;
}

/// How many letters must be inserted, removed or replaced to make one of the other.
std::size_t editDistance(std::string_view from, std::string_view to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

[[noreturn]] void refuseKey(const std::string& file, const toml::key& key,
                            const std::vector<std::string_view>& known) {
    const auto nearest = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
        return editDistance(key.str(), a) < editDistance(key.str(), b);
    });
    fail(file, key.source().begin.line,
         fmt::format("unknown key \"{}\"; did you mean \"{}\"?", key.str(), *nearest));
}

/// The entries of @p table as the file has them; toml++ sorts them by key.
std::vector<std::pair<toml::key, const toml::node*>> inFileOrder(const toml::table& table) {
    std::vector<std::pair<toml::key, const toml::node*>> entries;
    for (const auto& [key, node] : table) entries.emplace_back(key, &node);
    const auto position = [](const auto& entry) {
        const toml::source_position begin = entry.first.source().begin;
        return std::pair(begin.line, begin.column);
    };
    std::sort(entries.begin(), entries.end(),
              [&](const auto& a, const auto& b) { return position(a) < position(b); });
    return entries;
}

/// "KEY [grade]: document".
Profile::Source readSource(const Value& value) {
    const std::string text = value.text();
    const auto open = text.find(" ["), close = text.find("]: ");
    if (open == 0 || open == std::string::npos || close == std::string::npos || close < open)
        value.refuse(fmt::format("\"{}\" in sources must be \"KEY [grade]: document\"", text));
    const std::string key = "the grade of a source";
    return {text.substr(0, open),
            Value{value.file, key, value.node}.word<Evidence>(text.substr(open + 2, close - open - 2)),
            text.substr(close + 3)};
}

void readSources(Profile& profile, const Value& value) {
    profile.sources = value.list(readSource);
    std::set<std::string> seen;
    for (const Profile::Source& source : profile.sources)
        if (!seen.insert(source.key).second) value.refuse(fmt::format("sources has {} twice", source.key));
}

/// What the parts "source" and "grade" of a fact say, and where; graded when all of the file is read.
struct Claim {
    std::string text{};
    std::size_t line = 0;
    std::optional<Evidence> grade{};
};

/// Reads "{ value = ..., source = ..., also = ..., grade = ... }" or a plain value, and notes it as a fact.
Claim readFact(const std::string& file, const std::string& key, const toml::node& node, const Read& read,
               Profile& profile) {
    const toml::node* value = &node;
    Claim claim{.line = lineOf(node)};
    std::string also;
    if (const toml::table* table = node.as_table()) {
        for (const auto& [part, content] : inFileOrder(*table)) {
            if (part != "value" && part != "source" && part != "also" && part != "grade")
                refuseKey(file, part, {"value", "source", "also", "grade"});
            if (part == "source") {
                claim.text = Value{file, key + "'s source", *content}.text();
                claim.line = lineOf(*content);
                if (claim.text.empty()) fail(file, claim.line, key + "'s source is empty");
            }
            if (part == "also") also = Value{file, key + "'s also", *content}.text();
            if (part == "grade") {
                const std::string which = key + "'s grade";
                const Value word{file, which, *content};
                claim.grade = word.word<Evidence>(word.text());
            }
        }
        value = table->get("value");
        if (!value) fail(file, lineOf(node), fmt::format("{} has no value", key));
    }
    const bool sourced = !claim.text.empty();
    if (!sourced) claim.text = "unsourced";
    const Value reading{file, key, *value, sourced};
    read(profile, reading);
    profile.facts.push_back(
        {key, reading.written(), also.empty() ? claim.text : fmt::format("{}; also {}", claim.text, also)});
    return claim;
}

/// Whether @p text is @p word, or begins with it and goes on with a place or an explanation.
bool beginsWith(std::string_view text, std::string_view word) {
    return text.starts_with(word) &&
           (text.size() == word.size() || std::string_view(" :,").find(text[word.size()]) != text.npos);
}

/// The grade of the fact @p key of the file, which makes @p claim.
Evidence gradeOf(const Profile& profile, const std::string& key, const Claim& claim,
                 const std::string& file) {
    std::string_view rest = claim.text;
    if (beginsWith(rest, "unsourced")) {
        if (claim.grade.value_or(Evidence::Guess) != Evidence::Guess)
            fail(file, claim.line,
                 fmt::format("{} is unsourced: its grade is guess, not {}", key, name(*claim.grade)));
        return Evidence::Guess;
    }
    const bool derived = beginsWith(rest, "derived");
    if (derived) rest.remove_prefix(std::min(rest.size(), std::string_view("derived: ").size()));
    Evidence best = Evidence::Guess;
    while (!rest.empty()) {
        const std::string_view part = rest.substr(0, rest.find("; "));
        const auto source =
            std::find_if(profile.sources.begin(), profile.sources.end(),
                         [&](const Profile::Source& candidate) { return beginsWith(part, candidate.key); });
        if (source == profile.sources.end())
            fail(file, claim.line, fmt::format("\"{}\", a source of {}, is not in sources", part, key));
        best = std::min(best, source->grade);
        rest.remove_prefix(std::min(rest.size(), part.size() + 2));
    }
    return claim.grade.value_or(derived ? Evidence::Derived : best);
}

/// @return the claim behind it, if the entry is a fact
std::optional<Claim> readEntry(const std::string& file, const toml::key& tomlKey, const toml::node& node,
                               Profile& profile) {
    const std::string key(tomlKey.str());
    const Value value{file, key, node};
    if (key == "title") {
        profile.title = value.text();
    } else if (key == "year") {
        profile.year = static_cast<int>(value.whole(1950, 2100));
    } else if (key == "sources") {
        readSources(profile, value);
    } else {
        const auto field =
            std::find_if(fields().begin(), fields().end(), [&](const Field& f) { return f.key == key; });
        if (field == fields().end()) {
            std::vector<std::string_view> known{"title", "year", "sources"};
            for (const Field& f : fields()) known.push_back(f.key);
            refuseKey(file, tomlKey, known);
        }
        return readFact(file, key, node, field->read, profile);
    }
    return {};
}

std::string contentOf(const std::filesystem::path& file) {
    // Before it is opened: a FIFO would block, a device might never end.
    std::error_code error;
    const bool isRegular = std::filesystem::is_regular_file(file, error);
    std::ifstream in;
    if (isRegular) in.open(file, std::ios::binary);
    if (!isRegular || !in) fail(file.string() + ": can't be read");
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error) fail(file.string() + ": can't be read");
    if (size > kMostBytes)
        fail(
            fmt::format("{}: {} bytes, more than the {} that gnomon reads", file.string(), size, kMostBytes));
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
}

toml::table parse(const std::string& content, const std::string& file) {
    if (const std::size_t line = lineOfDeepKey(content); line > 0)
        fail(file, line, fmt::format("a key of more than {} parts", kMostKeyParts));
    try {
        return toml::parse(content, file);
    } catch (const toml::parse_error& error) {
        fail(file, error.source().begin.line, std::string(error.description()));
    }
}

}  // namespace

Profile loadProfile(const std::filesystem::path& path) {
    const std::string file = path.string();
    const toml::table root = parse(contentOf(path), file);

    // Each entry by itself.
    Profile profile;
    profile.id = path.stem().string();
    std::map<std::string, std::size_t> lines;
    std::vector<Claim> claims;  // of the facts, in their order
    for (const auto& [key, node] : inFileOrder(root)) {
        if (auto claim = readEntry(file, key, *node, profile)) claims.push_back(std::move(*claim));
        lines[std::string(key.str())] = key.source().begin.line;
    }

    // All of them together. What is missing has no line: line 1 stands for the file.
    if (profile.title.empty()) fail(file, lines.contains("title") ? lines["title"] : 1, "title is missing");
    for (std::size_t i = 0; i < claims.size(); ++i)
        profile.facts[i].grade = gradeOf(profile, profile.facts[i].key, claims[i], file);
    for (const Contradiction& found : contradictions(profile))
        fail(file, lines.contains(found.key) ? lines[found.key] : 1, found.what);
    return profile;
}

std::vector<std::string> profileIds(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder)) fail(folder.string() + ": is not a folder");
    std::vector<std::string> ids;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml") ids.push_back(entry.path().stem().string());
    std::sort(ids.begin(), ids.end());
    return ids;
}

}  // namespace gnomon
