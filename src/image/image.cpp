#include "image/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cassert>
#include <stdexcept>
#include <string>
#include <system_error>

namespace gnomon {
namespace {

// Else OpenImageIO multiplies colours by alpha when it reads, and divides when it writes.
constexpr const char* kKeepColours = "oiio:UnassociatedAlpha";

/// A name beside @p file that no other process uses; the extension stays, it chooses the format.
std::filesystem::path temporaryBeside(const std::filesystem::path& file) {
    const std::string name =
        fmt::format(".{}.{}{}", file.stem().string(), getpid(), file.extension().string());
    return file.parent_path() / name;
}

[[noreturn]] void fail(const std::filesystem::path& file, std::string what) {
    // The user knows the file by its own name only.
    const std::string temporary = temporaryBeside(file).string();
    for (std::size_t at; (at = what.find(temporary)) != std::string::npos;)
        what.replace(at, temporary.size(), file.string());
    while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) what.pop_back();
    for (char& c : what)
        if (c == '\n' || c == '\r') c = ' ';
    throw std::runtime_error(fmt::format("{}: {}", file.string(), what.empty() ? "unknown error" : what));
}

void writeNow(const std::filesystem::path& named, const std::filesystem::path& file, const Image& image) {
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output) fail(named, OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec.attribute(kKeepColours, 1);
    const bool written = output->open(file.string(), spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, image.data.data()) && output->close();
    if (!written) fail(named, output->geterror());
}

}  // namespace

void writeImage(const std::filesystem::path& file, const Image& image) {
    assert(image.width > 0 && image.height > 0 && image.channels > 0);
    assert(image.data.size() == std::size_t(image.width) * image.height * image.channels);
    const std::filesystem::path temporary = temporaryBeside(file);
    std::error_code error;
    try {
        writeNow(file, temporary, image);
    } catch (...) {
        std::filesystem::remove(temporary, error);
        throw;
    }
    std::filesystem::rename(temporary, file, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    fail(file, why);
}

Image readImage(const std::filesystem::path& file) {
    OIIO::ImageSpec config;
    config.attribute(kKeepColours, 1);
    const auto input = OIIO::ImageInput::open(file.string(), &config);
    if (!input) fail(file, OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    Image image{.width = spec.width, .height = spec.height, .channels = spec.nchannels};
    image.data.resize(std::size_t(spec.width) * spec.height * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, image.data.data()))
        fail(file, input->geterror());
    return image;
}

}  // namespace gnomon
