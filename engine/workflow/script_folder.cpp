#include "workflow/script_folder.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <set>

#include "documents/bibliography.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// With its time, by which one tells whether a PDF is older than its sources.
void copy_with_time(const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to);
    fs::last_write_time(to, fs::last_write_time(from));
}

/// Names in quotes, of files that lie beside the script.
std::set<std::string> files_named_in(const std::string& source, const fs::path& beside) {
    static const RE2 kQuoted(R"(["']([^"'\\\n]{1,200})["'])", RE2::Latin1);
    std::set<std::string> names;
    std::string quoted;
    for (re2::StringPiece rest = source; RE2::FindAndConsume(&rest, kQuoted, &quoted);) {
        const fs::path name = quoted;
        if (name == name.filename() && fs::is_regular_file(fs::symlink_status(beside / name))) names.insert(name);
    }
    return names;
}

}  // namespace

void make_script_folder(const fs::path& script, const fs::path& folder) {
    const PercentScript read = read_script_or_notebook(script);
    const fs::path beside = fs::absolute(script).parent_path();
    if (is_notebook(script)) {
        write_file_atomically(folder / "analysis.lua", read.source);
        fs::last_write_time(folder / "analysis.lua", fs::last_write_time(script));
    } else {
        copy_with_time(script, folder / "analysis.lua");
    }
    const std::string title = read.header.title.empty() ? script.stem().string() : read.header.title;
    const fs::path text = folder / "report.md";
    write_file_atomically(text, fmt::format("---\ntitle: '{}'\nlang: {}\n---\n\n::: {{.cells}}\n:::\n",
                                            replaced(title, "'", "''"), read.header.language));
    fs::last_write_time(text, fs::last_write_time(script));
    std::set<std::string> names = files_named_in(read.source, beside);
    if (const fs::path literature = bibliography_of(read); !literature.empty()) {
        // A link would bring in a file from elsewhere, and with it what its owner never meant to hand in.
        if (const Message fault = why_no_bibliography(literature); !fault.empty())
            throw DocumentError(Place{literature}, fault);
        names.insert(literature.filename());
    }
    for (const std::string& name : names)
        if (!fs::exists(folder / name)) copy_with_time(beside / name, folder / name);
    const fs::path pdf = fs::path(script).replace_extension(".pdf");
    if (fs::is_regular_file(fs::symlink_status(pdf))) copy_with_time(pdf, folder / "report.pdf");
}

}  // namespace dynlab::inline workflow
