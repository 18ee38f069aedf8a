#include "matrix/run_maker.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "matrix/digest.h"
#include "matrix/probe.h"

namespace gnomon {
namespace {

std::string processorName() {
    std::ifstream facts("/proc/cpuinfo");
    for (std::string line; std::getline(facts, line);)
        if (line.starts_with("model name"))
            if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    return "unknown";
}

std::uint64_t programDigest() {
    std::ifstream file("/proc/self/exe", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Digest digest;
    digest.add(bytes);
    return digest.value();
}

std::string withoutVectorWidth(const std::string& driver) {
    static const std::regex kWidth(", [0-9]+ bits");
    return std::regex_replace(driver, kWidth, "");
}

}  // namespace

RunMaker runMaker(const std::string& version, Device device) {
    const DriverFacts facts = probe(device);
    if (!facts.problem.empty()) throw std::runtime_error(facts.problem);
#ifdef __clang__
    const char* const compiler = "clang " __clang_version__;
#else
    const char* const compiler = "g++ " __VERSION__;
#endif
    return {version, compiler, withoutVectorWidth(facts.driver), processorName(), programDigest()};
}

}  // namespace gnomon
