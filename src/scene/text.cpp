#include "scene/text.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "scene/weld.h"

namespace gnomon {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr std::size_t kLongest = 200;
    std::string out;
    for (const char c : text.substr(0, kLongest)) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        if (control && (out.empty() || out.back() == ' ')) continue;
        out += control ? ' ' : c;
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return text.size() > kLongest ? out + "..." : out;
}

void fail(const std::filesystem::path& file, std::string_view what) {
    throw SceneError(fmt::format("{}: {}", printable(file.string()), what));
}

void fail(const std::filesystem::path& file, std::size_t line, std::string_view what) {
    throw SceneError(fmt::format("{}:{}: {}", printable(file.string()), line, what));
}

std::string readWhole(const std::filesystem::path& file, std::uint64_t most) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) fail(file, "no such file");
    if (error) fail(file, error.message());
    if (std::filesystem::is_directory(status)) fail(file, "is a directory");
    if (!std::filesystem::is_regular_file(status)) fail(file, "is no regular file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(file, "can't be opened");
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error) fail(file, error.message());
    if (size > most) fail(file, fmt::format("{} bytes, more than the {} that gnomon reads", size, most));
    std::string data(size, '\0');
    stream.read(data.data(), std::streamsize(data.size()));
    if (stream.gcount() != std::streamsize(data.size())) fail(file, "can't be read");
    return data;
}

bool Lines::next() {
    if (m_rest.empty()) return false;
    const std::size_t end = m_rest.find('\n');
    m_line = m_rest.substr(0, end);
    m_rest.remove_prefix(end == std::string_view::npos ? m_rest.size() : end + 1);
    if (!m_line.empty() && m_line.back() == '\r') m_line.remove_suffix(1);
    ++m_number;
    return true;
}

void splitWords(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    std::size_t at = 0;
    while (true) {
        while (at < line.size() && isBlank(line[at])) ++at;
        if (at == line.size()) return;
        const std::size_t begin = at;
        while (at < line.size() && !isBlank(line[at])) ++at;
        words.push_back(line.substr(begin, at - begin));
    }
}

std::optional<double> parseNumber(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return {};
    // Too large or too small; strtod tells which.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
    return value;
}

std::string coordinateFault(double value) {
    if (!std::isfinite(value)) return "coordinate is not finite";
    if (std::abs(value) > kMaxCoordinate)
        return fmt::format("coordinate {:g} is too large (at most {:g})", value, kMaxCoordinate);
    return {};
}

}  // namespace gnomon
