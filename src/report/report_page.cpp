#include "report/report_page.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "report/deflate.h"

// Of report_page.S.
extern "C" const char gnomon_report_page[], gnomon_report_page_end[];

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMark = "<!-- gnomon:data -->";

std::string block(std::string_view type, std::string_view id, std::string_view content) {
    return fmt::format("<script type=\"{}\" id=\"gnomon-{}\">{}</script>\n", type, id, content);
}

std::string headOf(const Json& run, const RunPictures& pictures) {
    Json chunks = Json::array();
    std::size_t offset = 0;
    for (const PackedChunk& chunk : pictures.chunks) {
        chunks.push_back({{"offset", offset}, {"size", chunk.deflated.size()}, {"length", chunk.length}});
        offset += chunk.deflated.size();
    }
    return Json{{"format", 1}, {"run", {{"length", run.dump().size()}}}, {"chunks", chunks}}.dump();
}

}  // namespace

std::string_view bundledPage() {
    return {gnomon_report_page, std::size_t(gnomon_report_page_end - gnomon_report_page)};
}

std::string withData(std::string_view page, const Json& run, const RunPictures& pictures) {
    const std::size_t at = page.find(kMark);
    if (at == std::string_view::npos) throw std::runtime_error("the report's page has no place for data");
    std::string chunks;
    for (const PackedChunk& chunk : pictures.chunks) chunks += chunk.deflated;
    std::string text(page.substr(0, at));
    text += block("application/json", "head", headOf(run, pictures));
    text += block("text/plain", "run", base64(deflated(run.dump())));
    text += block("text/plain", "pictures", base64(chunks));
    text += page.substr(at + kMark.size());
    return text;
}

std::string reportPage(std::string_view page, Report report, std::size_t limit) {
    const auto pageOf = [&] { return withData(page, runJson(report), report.pictures); };
    std::size_t kept = 0;
    for (const PackedChunk& chunk : report.pictures.chunks) kept += chunk.deflated.size();
    std::string text = pageOf();
    while (text.size() > limit) {
        if (report.pictures.drawings.empty())
            throw ReportTooLarge(
                fmt::format("the report takes {:.2f} MB without any picture", double(text.size()) / 1e6));
        // Four letters hold three bytes; the index shrinks with the pictures.
        const std::size_t excess = (text.size() - limit) * 3 / 4 + 1;
        kept = excess < kept ? kept - excess : 0;
        report.pictures = fitted(std::move(report.pictures), kept);
        text = pageOf();
    }
    return text;
}

}  // namespace gnomon
