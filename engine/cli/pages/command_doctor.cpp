#include <fmt/format.h>

#include <iostream>
#include <set>

#include "app/kernel/kernel_spec.h"
#include "app/page/page_routes.h"
#include "base/reader.h"
#include "cli/commands.h"
#include "data_io/dataset_index.h"
#include "documents/latex.h"
#include "numerics/linalg/processor_level.h"
#include "platform/cache.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"
#include "platform/sandbox.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline cli {
namespace {

/// One line of the report; `remedy` is empty when all is well.
void show(const std::string& what, const std::string& state, bool well) {
    std::cout << fmt::format("{:<4} {:<22} {}\n", well ? "ok" : "--", what, state);
}

/// Looks for the programs; returns the packages that are missing.
std::set<std::string> check_programs() {
    std::set<std::string> missing;
    for (const NeededProgram& needed : needed_programs()) {
        const auto found = find_program(needed.program);
        if (!found) missing.insert(needed.package);
        show(needed.program, found ? found->string() + " (" + needed.purpose + ")" : "missing: " + needed.purpose,
             found.has_value());
    }
    return missing;
}

struct LatexFile {
    const char *file, *package, *purpose;
    bool needed;
};
constexpr LatexFile kLatexFiles[] = {
    {"lmodern.sty", "lmodern", "the documents' font", true},
    {"booktabs.sty", "texlive-latex-recommended", "tables", true},
    {"beamer.cls", "texlive-latex-recommended", "slides", true},
    {"pgfmath.sty", "texlive-pictures", "slides", true},
    {"amsmath.sty", "texlive-latex-base", "mathematics", true},
    {"frenchb.ldf", "texlive-lang-french", "documents in French only", false},
    {"luaotfload.sty", "texlive-luatex", "PDFs with Cyrillic, Greek, Arabic and other non-Latin text", false},
    {"NotoSerif-Regular.ttf", "fonts-noto-core", "their letters", false},
    {"NotoSerifCJK-Regular.ttc", "fonts-noto-cjk", "Chinese, Japanese and Korean letters", false},
};

/// Looks for the LaTeX files documents use; returns the packages that are missing.
std::set<std::string> check_latex() {
    std::set<std::string> missing;
    if (!find_program("kpsewhich")) return missing;
    for (const LatexFile& part : kLatexFiles) {
        ChildOptions look_up;
        look_up.command = {"kpsewhich", part.file};
        look_up.environment = {{"OSFONTDIR", kNotoFolders}};
        const bool there = run_child(look_up, "texlive-latex-base").exit_code == 0;
        if (!there && part.needed) missing.insert(part.package);
        show(part.file,
             (there         ? ""
              : part.needed ? "missing: "
                            : fmt::format("not installed ({}): ", part.package)) +
                 std::string(part.purpose),
             there || !part.needed);
    }
    return missing;
}

/// Reports how well grading can isolate submissions.
void check_isolation() {
    const auto obstacle = obstacle_to(Isolation::kFull);
    show("isolation", obstacle ? "process only; " + message_text(*obstacle) : "full (bubblewrap, seccomp), for grading",
         !obstacle);
}

/// Whether copies for peer review can be made.
void check_copies() {
    const bool there = find_program("gs").has_value();
    show("gs", there ? "creates copies for peer review" : "not installed (ghostscript): copies for peer review only",
         true);
}

/// Searches for the data sets; returns the packages whose data are missing.
std::set<std::string> check_data() {
    std::set<std::string> missing;
    const std::vector<std::string> names = dataset_names();
    show("data sets", std::to_string(names.size()), !names.empty());
    for (const std::string& name : names) {
        const auto package = missing_package(name);
        if (!package) continue;
        show(name, "missing: measured data", false);
        missing.insert(*package);
    }
    return missing;
}

/// Whether Jupyter would start this program.
void check_kernel() {
    const auto kernel = installed_kernel();
    std::error_code gone;
    const bool there = kernel && std::filesystem::exists(*kernel, gone);
    const std::string state = !kernel  ? "not installed (dynlab kernel install, for notebooks)"
                              : !there ? kernel->string() + " does not exist: dynlab kernel install"
                              : std::filesystem::equivalent(*kernel, running_program(), gone)
                                  ? "installed"
                                  : "installed by another program: " + kernel->string();
    show("Jupyter kernel", state, !kernel || there);
}

int examine() {
    std::set<std::string> missing = check_programs();
    missing.merge(check_latex());
    show("data and templates", shared_folder().string(), true);
    show("lessons", std::to_string(lessons().size()), !lessons().empty());
    missing.merge(check_data());
    check_isolation();
    check_copies();
    show("inner loops", processor_level() + std::string(" (processor instructions in use)"), true);
    show("editor of pages", has_editor() ? "CodeMirror" : "a plain text field (libjs-codemirror has more)", true);
    check_kernel();
    show("caches", Cache().root().string() + " (safe to delete)", true);
    if (missing.empty()) {
        std::cout << "\nNo problems found.\n";
        return kDone;
    }
    std::string command = "sudo apt install";
    for (const std::string& package : missing) command += " " + package;
    std::cout << "\nTo install missing packages:  " << command << '\n';
    return kMissingProgram;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("doctor", "Check that all dependencies of dynlab are installed");
    command->callback([&action] { action = examine; });
}

}  // namespace dynlab::inline cli
