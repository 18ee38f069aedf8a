#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gnomon {

/// Pixels of 8 bits per channel, channels interleaved, rows from the top. Alpha is a channel like any other:
/// nothing is multiplied by it, and its values go to a file and back unchanged.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint8_t> data{};

    bool operator==(const Image&) const = default;
};

/// Writes @p image as a PNG, whose name must end so. The file appears whole or not at all: it is written
/// beside its place under another name.
/// @pre data has width * height * channels bytes, none of them 0; 1 to 4 channels: grey, grey and alpha,
/// colour, colour and alpha
/// @throws std::runtime_error "file: what"
void writeImage(const std::filesystem::path& file, const Image& image);

/// Reads a PNG, as 8 bits per channel.
/// @throws std::runtime_error "file: what"
Image readImage(const std::filesystem::path& file);

}  // namespace gnomon
