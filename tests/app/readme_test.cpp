// The README's blocks are what the commands above them print. To bring them up to date:
//     GNOMON_UPDATE_README=1 build/release/tests/app_tests --gtest_filter='Readme.*'

#include <fmt/format.h>

#include <cstdlib>

#include "program.h"

namespace gnomon {
namespace {

const std::filesystem::path kReadme = std::filesystem::path(GNOMON_SOURCE) / "README.md";

/// A block "<!-- gnomon ARGUMENTS -->", a fence, text, a fence.
struct Block {
    std::vector<std::string> arguments{};
    std::size_t begin = 0, end = 0;  ///< of the text
};

std::vector<Block> blocksOf(const std::string& readme) {
    const std::string mark = "<!-- gnomon ", fence = "```\n";
    std::vector<Block> blocks;
    for (std::size_t at = 0; (at = readme.find(mark, at)) != std::string::npos;) {
        Block block;
        const std::size_t close = readme.find(" -->", at);
        std::istringstream words(readme.substr(at + mark.size(), close - at - mark.size()));
        for (std::string word; words >> word;) block.arguments.push_back(word);
        block.begin = readme.find(fence, close) + fence.size();
        block.end = readme.find(fence, block.begin);
        blocks.push_back(block);
        at = block.end;
    }
    return blocks;
}

class Readme : public ProgramTest {};

TEST_F(Readme, BlocksAreWhatTheirCommandsPrint) {
    std::string readme = contentOf(kReadme);
    const std::vector<Block> blocks = blocksOf(readme);
    ASSERT_GE(blocks.size(), 4u);
    const bool update = std::getenv("GNOMON_UPDATE_README") != nullptr;
    // From the last to the first: replacing one leaves the places of those before it.
    for (std::size_t i = blocks.size(); i-- > 0;) {
        const Outcome outcome = run(blocks[i].arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        if (update)
            readme.replace(blocks[i].begin, blocks[i].end - blocks[i].begin, outcome.out);
        else
            EXPECT_EQ(readme.substr(blocks[i].begin, blocks[i].end - blocks[i].begin), outcome.out);
    }
    if (update) std::ofstream(kReadme, std::ios::binary) << readme;
}

TEST_F(Readme, MapNamesEveryLayer) {
    const std::string readme = contentOf(kReadme);
    for (const auto& folder :
         std::filesystem::directory_iterator(std::filesystem::path(GNOMON_SOURCE) / "src")) {
        if (!folder.is_directory()) continue;
        EXPECT_NE(readme.find(fmt::format("src/{} ", folder.path().filename().string())), std::string::npos)
            << folder.path();
    }
}

TEST_F(Readme, NamesEveryCommand) {
    const std::string readme = contentOf(kReadme);
    for (const char* command :
         {"matrix", "render", "plan", "profiles", "methods", "reproduce", "prove", "mesh"})
        EXPECT_NE(readme.find(fmt::format("gnomon {}", command)), std::string::npos) << command;
}

}  // namespace
}  // namespace gnomon
