#include "workflow/cheat_sheet.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "documents/latex.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline workflow {
namespace {

/// Two columns of small type.
constexpr const char* kSheetBegin = R"(\begin{document}
\newgeometry{top=8mm,bottom=8mm,left=8mm,right=8mm,footskip=0mm,headheight=0mm,headsep=0mm}
\pagestyle{empty}
\setlength{\columnsep}{5mm}\setlength{\parskip}{0pt}\raggedbottom
\twocolumn[{\Large\bfseries\color{dlink}dynlab on two pages}\hfill{\small\color{dlfaint}
\texttt{help("lsim")} or \texttt{dynlab help lsim} shows the help page of a function}\vspace{2mm}]
\fontsize{6.4}{7.1}\selectfont\frenchspacing\raggedright\hyphenpenalty=10000\exhyphenpenalty=10000\thispagestyle{empty}
\newcommand{\dynlabarea}[1]{\par\penalty-200\vspace{0.6mm}{\bfseries\color{dlink}#1}\par\nobreak}
\newcommand{\dynlabrow}[2]{{\hangindent=2em\hangafter=1\noindent\texttt{\color{dlkeyword}#1}\enspace #2\par}}
)";

/// Whether a word is one of an equation: "B/F", "y", "+", "=", the last one with a comma behind it.
bool is_symbol(std::string_view word) {
    static const RE2 kSymbol("[A-Z](/[A-Z])?|[euvy]|[=+]", RE2::Latin1);
    return RE2::FullMatch(word, kSymbol);
}

constexpr char kTie = '\t';  // a space at which no line breaks

/// The text with ties in braces, but for those behind commas, and in equations.
std::string tied(std::string_view text) {
    std::string result(text);
    int depth = 0;
    std::size_t word = 0;  // where the word before the next space begins
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (result[i] == '{' || result[i] == '[') ++depth;
        if (result[i] == '}' || result[i] == ']') --depth;
        if (result[i] != ' ') continue;
        const std::size_t next = i + 1, end = std::min(result.find_first_of(" ,", next), result.size());
        const bool equation = is_symbol(text.substr(word, i - word)) && is_symbol(text.substr(next, end - next));
        if (equation || (depth > 0 && i > 0 && result[i - 1] != ',')) result[i] = kTie;
        word = next;
    }
    return result;
}

std::string latex_words(std::string_view text) {
    std::string latex;
    for (const char c : text) switch (c) {
            case '\\':
                latex += "\\textbackslash{}";
                break;
            case '^':
                latex += "\\textasciicircum{}";
                break;
            case kTie:
                latex += '~';
                break;
            case '~':
                latex += "\\textasciitilde{}";
                break;
            case '\'':
                latex += "\\textquotesingle{}";
                break;
            case '-':
                latex += "{-}";  // two of them are no dash
                break;
            case '#':
            case '$':
            case '%':
            case '&':
            case '_':
            case '{':
            case '}':
                latex += '\\';
                [[fallthrough]];
            default:
                latex += c;
        }
    return latex;
}

/// The code between backticks in typewriter type.
std::string latex_cell(std::string_view markdown) {
    std::string latex, piece;
    bool code = false;
    const auto end_piece = [&] {
        const std::string words = latex_words(tied(piece));
        latex += code ? "\\texttt{" + words + "}" : replaced(words, R"(R\_T\textasciicircum{}2)", "$R_T^2$");
        piece.clear();
    };
    for (std::size_t i = 0; i < markdown.size(); ++i) {
        if (markdown[i] == '`') {
            end_piece();
            code = !code;
        } else if (markdown[i] != '\\' || i + 1 == markdown.size() || markdown[i + 1] != '|') {
            piece += markdown[i];
        }
    }
    end_piece();
    return latex;
}

/// The two cells of a row of a table, in which \| is no border; nothing for other lines and heads.
std::vector<std::string> cells_of(std::string_view line) {
    if (!line.starts_with("| ") || line.starts_with("| MATLAB")) return {};
    std::vector<std::string> cells;
    std::string cell;
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '|' && line[i - 1] != '\\') {
            cells.push_back(trimmed(cell));
            cell.clear();
        } else {
            cell += line[i];
        }
    }
    return cells.size() == 2 ? cells : std::vector<std::string>();
}

/// How a function is called, without what it gives and further forms.
std::string called(const FunctionEntry& entry) {
    const std::string signature = signature_text(entry);
    return trimmed(signature.substr(0, std::min(signature.find("->"), signature.find(';'))));
}

std::string functions_by_area() {
    std::vector<std::string_view> areas;
    for (const FunctionEntry& entry : catalog_of_functions())
        if (std::find(areas.begin(), areas.end(), entry.area) == areas.end()) areas.emplace_back(entry.area);
    std::string latex;
    for (const std::string_view area : areas) {
        latex += fmt::format("\\dynlabarea{{{}}}\n", latex_words(area));
        for (const FunctionEntry& entry : catalog_of_functions())
            if (entry.area == area)
                latex += fmt::format("\\dynlabrow{{{}}}{{{}}}\n", latex_words(tied(called(entry))),
                                     latex_cell(entry.summary));
    }
    return latex;
}

std::string phrases() {
    std::string latex, head;
    for (const std::string& line : lines_of(find_help_page("matlab").value().text)) {
        if (line.starts_with("## "))
            head = fmt::format("\\dynlabarea{{From MATLAB: {}}}\n", latex_words(line.substr(3)));
        const std::vector<std::string> cells = cells_of(line);
        if (!cells.empty())
            latex +=
                std::exchange(head, "") + fmt::format("{{\\hangindent=2em\\hangafter=1\\noindent {} $\\to$ {}\\par}}\n",
                                                      latex_cell(cells[0]), latex_cell(cells[1]));
    }
    return latex;
}

/// From \begin{document} on: every function with its summary, area by area, then the phrases of the page "matlab".
std::string cheat_sheet_latex() {
    return kSheetBegin + functions_by_area() + phrases() + "\\end{document}\n";
}

}  // namespace

void make_cheat_sheet(const std::filesystem::path& output) {
    if (output.extension() != ".pdf")
        throw EnvironmentError("the sheet is a PDF: give a file name such as cheat.pdf, not {}", output.string());
    const TemporaryFolder work;
    LatexJob job;
    job.body = cheat_sheet_latex();
    job.layout.shared_templates = shared_folder() / "report_templates";
    job.work_folder = work.path();
    job.identity = std::filesystem::absolute(output).lexically_normal().string();
    place_file_atomically(run_latex(job).pdf, output);
}

}  // namespace dynlab::inline workflow
