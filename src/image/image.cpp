#include "image/image.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cassert>
#include <stdexcept>
#include <string>

#include "image/whole_file.h"

namespace gnomon {
namespace {

/// By the number of channels, from 1.
constexpr std::array<png_uint_32, 4> kFormats{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                              PNG_FORMAT_RGBA};

/// What libpng holds for a picture while it is read or written.
class Png {
  public:
    Png() { m_png.version = PNG_IMAGE_VERSION; }
    ~Png() { png_image_free(&m_png); }
    Png(const Png&) = delete;
    Png& operator=(const Png&) = delete;

    png_image* operator->() { return &m_png; }
    png_image* get() { return &m_png; }

  private:
    png_image m_png{};
};

void writeNow(const std::filesystem::path& file, const Image& image) {
    if (file.extension() != ".png") throw std::runtime_error("is no .png");
    Png png;
    png->width = png_uint_32(image.width);
    png->height = png_uint_32(image.height);
    png->format = kFormats.at(std::size_t(image.channels) - 1);
    if (!png_image_write_to_file(png.get(), file.c_str(), 0, image.data.data(), 0, nullptr))
        throw std::runtime_error(png->message);
}

}  // namespace

void writeImage(const std::filesystem::path& file, const Image& image) {
    assert(image.width > 0 && image.height > 0 && image.channels > 0);
    assert(image.data.size() == std::size_t(image.width) * image.height * image.channels);
    writeWhole(file, [&](const std::filesystem::path& temporary) { writeNow(temporary, image); });
}

Image readImage(const std::filesystem::path& file) {
    Png png;
    const auto check = [&](int done) {
        if (!done) throw std::runtime_error(fmt::format("{}: {}", file.string(), png->message));
    };
    check(png_image_begin_read_from_file(png.get(), file.c_str()));
    png->format &= PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA;
    Image image{.width = int(png->width),
                .height = int(png->height),
                .channels = int(PNG_IMAGE_SAMPLE_CHANNELS(png->format))};
    image.data.resize(PNG_IMAGE_SIZE(*png.get()));
    check(png_image_finish_read(png.get(), nullptr, image.data.data(), 0, nullptr));
    return image;
}

}  // namespace gnomon
