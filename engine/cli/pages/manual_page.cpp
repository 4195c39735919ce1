#include "cli/pages/manual_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynlab::inline cli {
namespace {

/// Text as roff prints it: no letter of it is a command, and hyphens are those that one types.
std::string plain(const std::string& text) {
    std::string safe;
    bool line_begins = true;
    for (const char letter : text) {
        if (line_begins && (letter == '.' || letter == '\'')) safe += "\\&";
        if (letter == '\\')
            safe += "\\e";
        else if (letter == '-')
            safe += "\\-";
        else
            safe += letter;
        line_begins = letter == '\n';
    }
    return safe;
}

std::string in_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return plain(text);
}

/// "dynlab course import"
std::string words_of(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return parent == nullptr ? command.get_name() : words_of(*parent) + " " + command.get_name();
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command, bool positional) {
    return command.get_options([&](const CLI::Option* option) {
        return !option->get_group().empty() && option->get_positional() == positional;
    });
}

std::vector<const CLI::App*> shown_commands(const CLI::App& command) {
    return command.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); });
}

std::string usage(const CLI::App& command) {
    std::string line = "\\fB" + plain(words_of(command)) + "\\fR";
    if (!shown_commands(command).empty()) line += " \\fICOMMAND\\fR";
    if (!shown_options(command, false).empty()) line += " [\\fIOPTIONS\\fR]";
    for (const CLI::Option* option : shown_options(command, true)) {
        const std::string name = "\\fI" + plain(option->get_name(true)) + "\\fR";
        line += option->get_required() ? " " + name : " [" + name + "]";
    }
    return line + "\n";
}

std::string entry(const std::string& head, const std::string& text) {
    return fmt::format(".TP\n{}\n{}\n", head, text);
}

std::string options(const CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : shown_options(command, true))
        text += entry("\\fI" + plain(option->get_name(true)) + "\\fR", in_one_line(option->get_description()));
    for (const CLI::Option* option : shown_options(command, false)) {
        std::string head;
        for (const std::string& name : option->get_snames()) head += ", \\fB\\-" + plain(name) + "\\fR";
        for (const std::string& name : option->get_lnames()) head += ", \\fB\\-\\-" + plain(name) + "\\fR";
        if (option->get_expected_max() > 0) head += " \\fI" + plain(option->get_type_name()) + "\\fR";
        text += entry(head.substr(2), in_one_line(option->get_description()));
    }
    return text;
}

/// What belongs to a command whose own commands have no pages: each with its options, those below them, too.
std::string details(const CLI::App& command) {
    std::string text;
    for (const CLI::App* one : shown_commands(command)) {
        text += fmt::format(".SS {}{}\n{}{}", usage(*one), in_one_line(one->get_description()), options(*one),
                            details(*one));
    }
    return text;
}

}  // namespace

std::string manual_page(const CLI::App& command, const std::string& name, const std::string& version) {
    const bool whole_program = command.get_parent() == nullptr;
    std::string page = fmt::format(".TH \"{}\" 1 \"\" \"{}\" \"dynlab\"\n", plain(name), plain(version));
    page += fmt::format(".SH NAME\n{} \\- {}\n", plain(name), in_one_line(command.get_description()));
    page += ".SH SYNOPSIS\n" + usage(command) + ".SH OPTIONS\n" + options(command);
    if (!shown_commands(command).empty()) page += ".SH COMMANDS\n";
    if (whole_program) {
        for (const CLI::App* one : shown_commands(command))
            page +=
                entry("\\fB" + plain(name + "-" + one->get_name()) + "\\fR(1)", in_one_line(one->get_description()));
    } else {
        page += details(command);
    }
    if (const std::string footer = command.get_footer(); !footer.empty())
        page += ".SH NOTES\n.nf\n" + plain(footer) + "\n.fi\n";
    return page + ".SH SEE ALSO\n" + (whole_program ? "" : "\\fBdynlab\\fR(1), ") +
           "\\fBdynlab help\\fR: the functions of scripts, with examples\n";
}

}  // namespace dynlab::inline cli
