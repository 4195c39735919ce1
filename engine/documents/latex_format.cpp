#include "documents/latex_format.h"

#include <re2/re2.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fstream>
#include <sstream>

#include "base/catalog.h"
#include "base/languages.h"
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
    const Catalog* const catalog = catalog_of(layout.language);
    const std::string_view other = catalog ? catalog->translation(marked("babel", "english"), "babel") : "";
    const std::string language(other.empty() ? "english" : other);
    return {{"preamble.tex", read_file(folder / (layout.slides ? "slides_preamble.tex" : "preamble.tex"))},
            {"shared.tex", replaced(read_file(folder / "shared.tex"), "LANGUAGE", language)},
            {"characters.tex", read_file(folder / "characters.tex")},
            {"vietnamese.tex", read_file(folder / "vietnamese.tex")},
            {"unicode.tex", read_file(folder / "unicode.tex")}};
}

/// Size and date of the installed program and of Debian's LaTeX format, which every update of TeX rewrites.
std::string tex_version() {
    const auto pdflatex = find_program("pdflatex");
    if (!pdflatex) throw MissingProgram("pdflatex", "texlive-latex-base");
    return file_stamp(*pdflatex) + "\n" + file_stamp("/var/lib/texmf/web2c/pdftex/pdflatex.fmt");
}

ChildProcess begin_format(const LatexLayout& layout, const fs::path& folder) {
    write_preamble(layout, folder);
    ChildOptions child;
    child.command = {"pdflatex",
                     "-ini",
                     "-interaction=nonstopmode",
                     "-halt-on-error",
                     "-no-shell-escape",
                     std::string("-jobname=") + kLatexFormatName,
                     "&pdflatex \\input{preamble}\\dump"};
    child.folder = folder;
    child.environment = {{"max_print_line", "10000"},
                         {"openin_any", "p"},
                         {"openout_any", "p"},
                         {"MKTEXFMT", "0"},
                         {"TEXINPUTS", template_files(layout)}};
    child.processor_time = 60s;
    child.timeout = 600s;
    return ChildProcess(child, "texlive-latex-base");
}

/// TeX packs what it dumps, and to unpack it is more than half of its start. It reads plain bytes as well, so that one
/// unpacking serves all documents; a format that cannot be unpacked here serves as it is.
void unpack_format(const fs::path& format) {
    try {
        std::ifstream packed(format, std::ios::binary);
        boost::iostreams::filtering_istream bytes;
        bytes.push(boost::iostreams::gzip_decompressor());
        bytes.push(packed);
        std::ostringstream plain;
        boost::iostreams::copy(bytes, plain);
        write_file_atomically(format, plain.str());
    } catch (const std::ios_base::failure&) {  // not packed
    } catch (const EnvironmentError&) {        // no room
    }
}

void finish_format(ChildProcess& tex, const fs::path& folder) {
    const ChildResult run = tex.wait();
    const fs::path format = folder / (std::string(kLatexFormatName) + ".fmt");
    if (run.exit_code == 0 && fs::exists(format)) return unpack_format(format);
    check_missing_packages(run.output);
    static const RE2 kError("(?m)^! (.*)", RE2::Latin1);
    std::string complaint;
    const Message reason = RE2::PartialMatch(run.output, kError, &complaint)
                               ? Message::verbatim(complaint)
                               : Message("pdflatex stopped with exit code {}", run.exit_code);
    throw EnvironmentError("the layout of documents (report_templates/latex) cannot be prepared: {}", reason);
}

}  // namespace

void write_preamble(const LatexLayout& layout, const fs::path& folder) {
    for (const auto& [name, text] : preamble_files(layout)) write_work_file(folder / name, text);
}

std::string template_files(const LatexLayout& layout) {
    const std::string shared = fs::absolute(layout.shared_templates).string();
    return ".:" + shared + "/latex:" + shared + ":";
}

PrintableCharacters printable_by_pdflatex(const fs::path& shared_templates) {
    return PrintableCharacters::of_latex(read_file(shared_templates / "latex/characters.tex") +
                                         read_file(shared_templates / "latex/vietnamese.tex"));
}

void check_missing_packages(const std::string& log) {
    static const RE2 kNoFrench(R"(Unknown option [`'"]french['"]|[fF]ile [`'"]?french\.ldf)", RE2::Latin1),
        kNoFile(R"(File [`']([^']+\.(?:sty|cls|def|fd))' not found)", RE2::Latin1);
    if (RE2::PartialMatch(log, kNoFrench))
        throw MissingProgram(
            Message("the French language support of LaTeX (babel's french.ldf) is not installed. Install it with: sudo "
                    "apt install {}",
                    "texlive-lang-french"));
    if (std::string file; RE2::PartialMatch(log, kNoFile, &file))
        throw MissingProgram(Message("the LaTeX file {} is not installed. Install it with: sudo apt install {}", file,
                                     "texlive-latex-recommended texlive-fonts-recommended texlive-pictures lmodern"));
}

CachedLatexFormat::CachedLatexFormat(const LatexLayout& layout) {
    EntryName name("latex-formats", tex_version() + "\nunpacked");
    for (const auto& [file, text] : preamble_files(layout)) name.add(text);
    name_ = name.text();
    folder_ = cache_.find(name_);
    if (folder_) return;
    prepared_ = cache_.prepare();
    tex_ = begin_format(layout, prepared_);
}

CachedLatexFormat::~CachedLatexFormat() {
    tex_.reset();
    std::error_code ignored;
    if (!folder_) fs::remove_all(prepared_, ignored);
}

fs::path CachedLatexFormat::folder() {
    if (!folder_) {
        finish_format(*tex_, prepared_);
        folder_ = cache_.commit(prepared_, name_);
    }
    return *folder_;
}

void make_latex_format(const LatexLayout& layout, const fs::path& folder) {
    ChildProcess tex = begin_format(layout, folder);
    finish_format(tex, folder);
}

}  // namespace dynlab::inline documents
