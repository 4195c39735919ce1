#include <fmt/format.h>

#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/options/script_options.h"
#include "cli/say.h"
#include "documents/script_header.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/lint/lint.h"
#include "workflow/given_script.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "-";

struct LintArguments {
    std::vector<std::string> files;
    bool json = false;
};

std::string text_of(const std::string& file) {
    if (is_notebook(file)) return read_notebook(file).source;
    if (file != kStandardInput) return text_of_source(file);
    return {std::istreambuf_iterator<char>(std::cin), {}};
}

/// Files with checks have additional functions.
std::vector<std::string> names_in(const std::string& file, const CheckNames& check_names) {
    return fs::path(file).filename() == "checks.lua" ? check_names() : std::vector<std::string>();
}

/// Where editors find it; in a notebook, where people do.
std::string finding_place(const LintIssue& found, const std::string& file, const std::string& source) {
    const std::string cell = is_notebook(file) ? message_text(place_in_notebook(source, found.line), user()) : "";
    return cell.empty() ? fmt::format("{}:{}:{}", file, found.line, found.column) : fmt::format("{}, {}", file, cell);
}

int lint(const LintArguments& args, const CheckNames& check_names) {
    nlohmann::json all = nlohmann::json::array();
    std::string text;
    for (const std::string& given : args.files) {
        const std::string file = fs::is_directory(given) ? (fs::path(given) / "analysis.lua").string() : given;
        const std::string source = text_of(file);
        speak(language_of_script(source));
        for (const LintIssue& found : lint_script(source, file, names_in(file, check_names))) {
            all.push_back({{"file", file},
                           {"line", found.line},
                           {"column", found.column},
                           {"kind", found.kind},
                           {"message", message_text(found.message, user())}});
            text += fmt::format("{}: {}\n", finding_place(found, file, source), message_text(found.message, user()));
        }
    }
    if (args.json)
        std::cout << nlohmann::json{{"findings", all}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                  << '\n';
    else
        std::cout << terminal_text(text);
    return all.empty() ? kDone : kFailed;
}

std::string complaint_about(const std::string& given) {
    if (given == kStandardInput || fs::is_regular_file(given)) return {};
    if (fs::is_regular_file(fs::path(given) / "analysis.lua")) return {};
    try {
        meant_script(given);
        return {};
    } catch (const EnvironmentError& error) {
        return message_text(error.message(), user());
    }
}

}  // namespace

void add_lint(CLI::App& app, Action& action, const CheckNames& check_names) {
    auto args = std::make_shared<LintArguments>();
    CLI::App* command = app.add_subcommand("lint", "Find errors in scripts without running them");
    command
        ->add_option("FILE", args->files, "Scripts, notebooks, folders with an analysis.lua, or - for standard input")
        ->required()
        ->check(CLI::Validator([](std::string& given) { return complaint_about(given); }, "", "file"));
    command->add_flag("--json", args->json, "Print {findings: [{file, line, column, kind, message}]}");
    command->footer(
        "The command reports text that Lua cannot read, undefined names, unknown options of functions, and answers "
        "that the\n"
        "header does not declare or that are never submitted, each as FILE:LINE:COLUMN: message.\n"
        "Example:  dynlab lint analysis.lua\n"
        "Exit codes: 0 no errors, 1 errors were found, 2 wrong usage.");
    command->callback([args, check_names, &action] {
        for (const std::string& file : args->files) expect_script(file, "lint");
        action = [args, check_names] { return lint(*args, check_names); };
    });
}

}  // namespace dynlab::inline cli
