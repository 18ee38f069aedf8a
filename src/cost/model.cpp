#include "cost/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

struct Share {
    Resource resource;
    double ms;
};

std::array<Share, 4> sharesOf(const PassCost& pass) {
    return {{{Resource::Fill, pass.fillMs},
             {Resource::Bandwidth, pass.bandwidthMs},
             {Resource::Triangles, pass.triangleMs},
             {Resource::Bus, pass.busMs}}};
}

Share largest(const PassCost& pass) {
    const auto shares = sharesOf(pass);
    return *std::max_element(shares.begin(), shares.end(),
                             [](const Share& a, const Share& b) { return a.ms < b.ms; });
}

/// Milliseconds for @p amount at @p perMs; 0 without a rate.
double msOf(std::int64_t amount, double perMs) {
    return perMs > 0 ? double(amount) / perMs : 0;
}

}  // namespace

const std::string& name(Resource resource) {
    static const std::array<std::string, kResources> kNames{"fill", "bandwidth", "triangles", "bus", "host"};
    return kNames[std::size_t(resource)];
}

double PassCost::ms() const {
    return largest(*this).ms;
}

std::optional<Resource> PassCost::limit() const {
    const Share share = largest(*this);
    if (share.ms <= 0) return std::nullopt;
    return share.resource;
}

double FrameCost::chipMs() const {
    double sum = 0;
    for (const PassCost& pass : passes) sum += pass.ms();
    return sum;
}

double FrameCost::ms() const {
    return std::max(hostMs, chipMs());
}

double FrameCost::framesPerSecond() const {
    return ms() > 0 ? 1000 / ms() : 0;
}

std::int64_t FrameCost::bytes() const {
    std::int64_t sum = 0;
    for (const PassCost& pass : passes) sum += pass.traffic.bytes();
    return sum;
}

std::optional<Resource> FrameCost::limit() const {
    if (ms() <= 0) return std::nullopt;
    if (hostMs >= chipMs()) return Resource::Host;
    std::array<double, kResources> together{};
    for (const PassCost& pass : passes)
        if (const auto limit = pass.limit()) together[std::size_t(*limit)] += pass.ms();
    return Resource(std::max_element(together.begin(), together.end()) - together.begin());
}

PassCost passCost(PassKind kind, const PassTraffic& traffic, const Profile& profile) {
    PassCost cost{.kind = kind, .traffic = traffic};
    cost.fillMs = msOf(traffic.fragments, profile.megapixelsPerSecond * 1e3);
    if (!profile.onChipFrame) cost.bandwidthMs = msOf(traffic.bytes(), profile.gigabytesPerSecond * 1e6);
    cost.triangleMs = msOf(traffic.triangles, profile.megatrianglesPerSecond * 1e3);
    cost.busMs = msOf(traffic.busBytes, profile.busMegabytesPerSecond * 1e3);
    return cost;
}

FrameCost frameCost(const Plan& plan, const Profile& profile, std::span<const DrawnAmount> amounts,
                    std::span<const std::int64_t> passed, double hostMs) {
    assert(amounts.size() == plan.passes.size());
    assert(passed.empty() || passed.size() == plan.passes.size());
    FrameCost cost{.hostMs = hostMs, .countsPassed = !passed.empty()};
    PassTraffic all;
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const std::optional<std::int64_t> known = passed.empty() ? std::nullopt : std::optional(passed[i]);
        const PassTraffic traffic = trafficOf(plan.passes[i], profile, amounts[i], known);
        all.fragments += traffic.fragments, all.triangles += traffic.triangles;
        all.colourRead += traffic.bytes(), all.busBytes += traffic.busBytes;
        cost.passes.push_back(passCost(plan.passes[i].kind, traffic, profile));
    }
    const auto need = [&](std::int64_t amount, double rate, const char* what, const char* key) {
        if (amount > 0 && rate <= 0)
            cost.missing.push_back(fmt::format("no {} in the profile ({})", what, key));
    };
    need(all.fragments, profile.megapixelsPerSecond, "fill rate", "megapixels_per_second");
    if (!profile.onChipFrame)
        need(all.bytes(), profile.gigabytesPerSecond, "bandwidth", "gigabytes_per_second");
    need(all.triangles, profile.megatrianglesPerSecond, "triangle rate", "megatriangles_per_second");
    need(all.busBytes, profile.busMegabytesPerSecond, "bus rate", "bus_megabytes_per_second");
    return cost;
}

bool hasModelRates(const Profile& profile) {
    return profile.megapixelsPerSecond > 0 && (profile.onChipFrame || profile.gigabytesPerSecond > 0);
}

std::int64_t rankedNs(const FrameCost& cost) {
    return std::llround(cost.ms() * 1e6);
}

std::vector<std::string> modelRates(const Profile& profile) {
    std::vector<std::string> rates;
    const auto add = [&](Resource resource, double rate, const char* unit, const char* key) {
        if (rate > 0)
            rates.push_back(fmt::format("{} {} {} [{}]", name(resource), rate, unit, profile.sourceOf(key)));
    };
    add(Resource::Fill, profile.megapixelsPerSecond, "Mpixel/s", "megapixels_per_second");
    if (profile.onChipFrame)
        rates.push_back(fmt::format("bandwidth without limit, the frame is on the chip [{}]",
                                    profile.sourceOf("on_chip_frame")));
    else
        add(Resource::Bandwidth, profile.gigabytesPerSecond, "GB/s", "gigabytes_per_second");
    add(Resource::Triangles, profile.megatrianglesPerSecond, "Mtriangle/s", "megatriangles_per_second");
    add(Resource::Bus, profile.busMegabytesPerSecond, "MB/s", "bus_megabytes_per_second");
    return rates;
}

}  // namespace gnomon
