#include "documents/latex_format.h"

#include <regex>

#include "documents/text_lines.h"
#include "documents/work_file.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// The files that make a preamble: the names they are written under, and their texts.
std::vector<std::pair<std::string, std::string>> preamble_files(const LatexLayout& layout) {
    const fs::path folder = layout.shared_templates / "latex";
    const std::string language = layout.language == "fr" ? "french" : "english";
    return {{"preamble.tex", read_file(folder / (layout.slides ? "slides_preamble.tex" : "preamble.tex"))},
            {"shared.tex", replaced(read_file(folder / "shared.tex"), "LANGUAGE", language)},
            {"characters.tex", read_file(folder / "characters.tex")}};
}

/// Size and date of the installed program and of Debian's LaTeX format, which every update of TeX rewrites.
std::string tex_version() {
    const auto pdflatex = find_program("pdflatex");
    if (!pdflatex) throw MissingProgram("pdflatex", "texlive-latex-base");
    return file_stamp(*pdflatex) + "\n" + file_stamp("/var/lib/texmf/web2c/pdftex/pdflatex.fmt");
}

void compile_format(const fs::path& folder) {
    ChildOptions child;
    child.command = {"pdflatex",
                     "-ini",
                     "-interaction=nonstopmode",
                     "-halt-on-error",
                     "-no-shell-escape",
                     std::string("-jobname=") + kLatexFormatName,
                     "&pdflatex \\input{preamble}\\dump"};
    child.folder = folder;
    child.environment = {{"max_print_line", "10000"}, {"openin_any", "p"}, {"openout_any", "p"}, {"MKTEXFMT", "0"}};
    child.timeout = 60s;
    const ChildResult run = run_child(child, "texlive-latex-base");
    const fs::path format = folder / (std::string(kLatexFormatName) + ".fmt");
    if (run.exit_code == 0 && fs::exists(format)) return;
    check_missing_packages(run.output);
    std::smatch error;
    const bool found = std::regex_search(run.output, error, std::regex("(^|\n)! ([^\n]*)"));
    throw EnvironmentError("the layout of documents (report_templates/latex) cannot be prepared: " +
                           (found ? error[2].str() : "pdflatex ended with code " + std::to_string(run.exit_code)));
}

}  // namespace

void write_preamble(const LatexLayout& layout, const fs::path& folder) {
    for (const auto& [name, text] : preamble_files(layout)) write_work_file(folder / name, text);
}

void check_missing_packages(const std::string& log) {
    std::smatch found;
    if (std::regex_search(log, found, std::regex("Unknown option [`'\"](french)['\"]")) ||
        std::regex_search(log, found, std::regex("(?:file|File) [`'\"]?(french\\.ldf)")))
        throw MissingProgram("the French language of LaTeX (babel's french.ldf)", "texlive-lang-french");
    if (std::regex_search(log, found, std::regex("File [`']([^']+\\.(sty|cls|def|fd))' not found")))
        throw MissingProgram("the LaTeX file " + found[1].str(),
                             "texlive-latex-recommended texlive-fonts-recommended texlive-pictures lmodern");
}

fs::path latex_format_folder(const LatexLayout& layout) {
    const Cache cache;
    EntryName name("latex-formats", tex_version());
    for (const auto& [file, text] : preamble_files(layout)) name.add(text);
    if (const auto folder = cache.find(name.text())) return *folder;
    const fs::path folder = cache.prepare();
    make_latex_format(layout, folder);
    return cache.commit(folder, name.text());
}

void make_latex_format(const LatexLayout& layout, const fs::path& folder) {
    write_preamble(layout, folder);
    compile_format(folder);
}

}  // namespace dynlab::inline documents
