#include "image/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cassert>
#include <stdexcept>
#include <string>

#include "image/whole_file.h"

namespace gnomon {
namespace {

// Else OpenImageIO multiplies colours by alpha when it reads, and divides when it writes.
constexpr const char* kKeepColours = "oiio:UnassociatedAlpha";

[[noreturn]] void fail(const std::filesystem::path& file, std::string what) {
    while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) what.pop_back();
    for (char& c : what)
        if (c == '\n' || c == '\r') c = ' ';
    throw std::runtime_error(fmt::format("{}: {}", file.string(), what.empty() ? "unknown error" : what));
}

void writeNow(const std::filesystem::path& file, const Image& image) {
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output) throw std::runtime_error(OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec.attribute(kKeepColours, 1);
    const bool written = output->open(file.string(), spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, image.data.data()) && output->close();
    if (!written) throw std::runtime_error(output->geterror());
}

}  // namespace

void writeImage(const std::filesystem::path& file, const Image& image) {
    assert(image.width > 0 && image.height > 0 && image.channels > 0);
    assert(image.data.size() == std::size_t(image.width) * image.height * image.channels);
    writeWhole(file, [&](const std::filesystem::path& temporary) { writeNow(temporary, image); });
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
