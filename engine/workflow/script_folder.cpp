#include "workflow/script_folder.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <set>

#include "documents/bibliography.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/pictures.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/files/inside_folder.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// Copies the modification time, too, which shows whether a PDF is older than its sources.
void copy_with_time(const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to);
    fs::last_write_time(to, fs::last_write_time(from));
}

/// The files beside the script, or in folders there, that it names: data and modules in quotes, pictures in its text.
class FilesNamed {
  public:
    explicit FilesNamed(const fs::path& beside) : beside_(beside) {}

    std::set<std::string> in(const std::string& source) {
        static const RE2 kQuoted(R"(["']([^"'\\\n]{1,200})["'])", RE2::Latin1),
            kAddress(R"((?m)^(?:--)?\s*\[[^\]\n]+\]:\s*<?([^>\n]{1,300}))", RE2::Latin1);
        std::string name;
        for (re2::StringPiece rest = source; RE2::FindAndConsume(&rest, kQuoted, &name);) {
            for (const char* ending : {"", ".csv", ".mat"}) add(name + ending);
            add(replaced(name, ".", "/") + ".lua");
        }
        for (re2::StringPiece rest = source; RE2::FindAndConsume(&rest, kAddress, &name);) add_picture(name);
        for (std::size_t at = source.find("]("); at != std::string::npos; at = source.find("](", at + 2))
            add_picture(in_brackets(source, at + 2));
        return std::move(names_);
    }

  private:
    /// Up to the bracket that closes the one before `begin`.
    static std::string in_brackets(const std::string& text, std::size_t begin) {
        constexpr std::size_t kMaxLength = 300;
        int depth = 1;
        for (std::size_t end = begin; end < std::min(text.size(), begin + kMaxLength); ++end) {
            depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
            if (depth == 0) return text.substr(begin, end - begin);
        }
        return "";
    }

    /// `address`: as Markdown has it, perhaps in <>, with %20 or a backslash for a space, and with a title behind it.
    void add_picture(std::string address) {
        address = trimmed(address);
        if (address.starts_with('<')) address = address.substr(1, address.find('>') - 1);
        static const RE2 kTitle(R"re(\s+("[^"]*"|'[^']*'|\([^)]*\))$)re", RE2::Latin1),
            kEscape(R"(\\(.))", RE2::Latin1);
        RE2::Replace(&address, kTitle, "");
        add(path_of_picture(address));
        RE2::GlobalReplace(&address, kEscape, R"(\1)");
        add(path_of_picture(address));
    }

    void add(const fs::path& name) {
        std::error_code no_name;  // a text that is too long for one
        const fs::path plain = name.lexically_normal();
        if (name.empty() || name.is_absolute() || *plain.begin() == "..") return;
        if (fs::is_regular_file(fs::symlink_status(beside_ / plain, no_name)) && is_inside(beside_ / plain, beside_))
            names_.insert(plain);
    }

    fs::path beside_;
    std::set<std::string> names_;
};

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
    std::set<std::string> names = FilesNamed(beside).in(read.source);
    if (const fs::path literature = bibliography_of(read); !literature.empty()) {
        // A link would bring in a file from elsewhere, which its owner never meant to submit.
        if (const Message fault = why_no_bibliography(literature); !fault.empty())
            throw DocumentError(Place{literature}, fault);
        names.insert(literature.filename());
    }
    for (const std::string& name : names) {
        if (fs::exists(folder / name)) continue;
        fs::create_directories((folder / name).parent_path());
        copy_with_time(beside / name, folder / name);
    }
    const fs::path pdf = fs::path(script).replace_extension(".pdf");
    if (fs::is_regular_file(fs::symlink_status(pdf))) copy_with_time(pdf, folder / "report.pdf");
}

}  // namespace dynlab::inline workflow
