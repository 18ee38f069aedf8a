// The manual page in the macros of man(7).

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "app/help.h"

namespace gnomon {
namespace {

/// @p text for troff: its own characters stand for themselves, and no line is taken for a request.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        if (c == '\n') out += "\\&";
    }
    return "\\&" + out;
}

/// Line breaks of a description mean nothing.
std::string inOneLine(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
    return escaped(line);
}

std::string heading(const std::string& name) {
    return fmt::format(".SH {}\n", name);
}

/// "\-\-size WxH", or "[scene], \-\-scene ID|FILE".
std::string tagOf(const CLI::Option& option) {
    const std::string name = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
    const std::string type = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
    std::vector<std::string> names;
    std::istringstream list(name);
    for (std::string one; std::getline(list, one, ',');) {
        const std::size_t first = one.find_first_not_of(' ');
        if (first == std::string::npos) continue;
        names.push_back(fmt::format("\\fB{}\\fR", escaped(one.substr(first))));
    }
    // Flags that were named beside a positional.
    if (option.get_positional())
        for (const std::string& flag : option.get_lnames())
            names.push_back(fmt::format("\\fB{}\\fR", escaped("--" + flag)));
    return fmt::format("{}{}", fmt::join(names, ", "),
                       type.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(type)));
}

std::string optionText(const CLI::Option& option) {
    std::string what = option.get_description();
    if (!option.get_default_str().empty()) what += fmt::format(" (default: {})", option.get_default_str());
    return fmt::format(".TP\n{}\n{}\n", tagOf(option), inOneLine(what));
}

std::string commandText(const CLI::App& command) {
    std::string text =
        fmt::format(".SS gnomon {}\n{}\n", command.get_name(), inOneLine(command.get_description()));
    for (const CLI::Option* option : command.get_options())
        if (option->get_group() != "") text += optionText(*option);
    for (const Example& example : examplesOf(command.get_name()))
        text += fmt::format(".PP\nExample, {}:\n.PP\n.nf\n.RS\n{}\n.RE\n.fi\n", inOneLine(example.what),
                            escaped(example.line));
    return text;
}

}  // namespace

std::string manPage(const CLI::App& app, const std::string& version) {
    std::string text = ".\\\" Made by gnomon help --man.\n";
    text += fmt::format(".TH GNOMON 1 \"\" \"{}\" \"User Commands\"\n", version);
    text += heading("NAME") +
            "gnomon \\- which shadow algorithm an old graphics chip can run, and how exact it is\n";
    text += heading("SYNOPSIS") + "\\fBgnomon\\fR \\fIcommand\\fR [\\fIoption\\fR]...\n";
    text += heading("DESCRIPTION") + inOneLine(app.get_description()) + "\n";
    text += heading("COMMANDS");
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        text += commandText(*command);
    text += heading("EXIT STATUS");
    text +=
        ".TP\n0\nas expected\n.TP\n1\na result or a published figure differs, or the chip can't draw it\n"
        ".TP\n2\nbad arguments or files; one line says which\n.TP\n3\nour own fault\n"
        ".TP\n128 + signal\nit was interrupted\n";
    text += heading("ENVIRONMENT");
    text +=
        ".TP\n\\fBCOLUMNS\\fR\nwidth of texts on a terminal, instead of its own\n"
        ".TP\n\\fBNO_COLOR\\fR\nset to anything: no colours unless \\fB\\-\\-colour always\\fR\n"
        ".TP\n\\fBTERM\\fR\nunset or \\fBdumb\\fR: neither progress nor colours\n";
    return text;
}

}  // namespace gnomon
