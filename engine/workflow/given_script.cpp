#include "workflow/given_script.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "documents/script_header.h"
#include "documents/template_file.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/files/inside_folder.h"
#include "platform/spelling.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScriptOfFolder = "analysis.lua";

/// What lies beside scripts and is given in their place. Scripts may have any other ending, or none.
Message kind_of(const std::string& ending) {
    static const std::pair<std::vector<std::string>, Message> kKinds[] = {
        {{".md"}, Message("a Markdown file")},
        {{".tex"}, Message("a LaTeX file")},
        {{".txt"}, Message("a text file")},
        {{".pdf"}, Message("a PDF")},
        {{".html"}, Message("a web page")},
        {{".docx", ".odt"}, Message("a document")},
        {{".csv", ".xlsx"}, Message("a data table")},
        {{".mat"}, Message("a data file")},
        {{".json"}, Message("a JSON file")},
        {{".toml"}, Message("a settings file")},
        {{".bib"}, Message("a bibliography")},
        {{".zip", ".gz", ".tgz"}, Message("an archive")},
        {{".png", ".jpg", ".jpeg", ".svg"}, Message("a picture")},
    };
    for (const auto& [endings, kind] : kKinds)
        if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return kind;
    return {};
}

bool is_script_name(const fs::path& file) {
    return ending_of(file) == ".lua" || ending_of(file) == ".ipynb";
}

bool is_small_file(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::regular &&
           std::filesystem::file_size(file, error) <= kMaxSourceSize && !error;
}

}  // namespace

Message why_no_script(const fs::path& given, const std::string& command) {
    const std::string ending = ending_of(given), name = given.filename().string();
    Message kind = kind_of(ending);
    std::error_code none;
    if (kind.empty() || !fs::is_regular_file(given, none)) return {};
    const fs::path folder = folder_around(given);
    if (!fs::is_regular_file(folder / kScriptOfFolder, none))
        return Message("{} is {}: give a script (.lua) or a notebook (.ipynb)", name, kind);
    if (in_small_letters(name) == "report.md") kind = Message("the report's text");
    if (in_small_letters(name) == "report.pdf") kind = Message("the report's PDF");
    return Message("{} is {}. Give the folder, for example: dynlab {} {}", name, kind, command,
                   shell_word(folder.string()));
}

Message nearly_called(const fs::path& folder, const std::string& name) {
    const std::string requested = in_small_letters(name), ending = ending_of(name);
    const std::string stem = requested.substr(0, requested.size() - ending.size());
    std::vector<std::string> near;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string there = entry.path().filename().string(), small = in_small_letters(there);
        if (there != name && small.starts_with(stem) && small.find(ending, stem.size()) != std::string::npos &&
            entry.is_regular_file(none))
            near.push_back(there);
    }
    if (near.empty())
        return fs::is_regular_file(folder / (stem + ".ipynb"), none) && ending == ".lua"
                   ? Message("but there is {}: give that file", stem + ".ipynb")
                   : Message();
    std::sort(near.begin(), near.end());
    constexpr std::size_t kMax = 3;
    near.resize(std::min(near.size(), kMax));
    return near.size() == 1 ? Message("but there is {}: rename it to {}", near.front(), name)
                            : Message("but there are {}: rename the correct file to {}", listed(near), name);
}

std::optional<fs::path> nearest_work(const fs::path& given) {
    const bool names_script = is_script_name(given);
    const std::string requested = (names_script ? given.stem() : given.filename()).string();
    std::vector<std::string> words;
    std::vector<fs::path> works;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_around(given), none)) {
        const fs::path& there = entry.path();
        if (is_script_name(there) && entry.is_regular_file(none))
            works.push_back(there.filename());
        else if (fs::is_regular_file(there / kScriptOfFolder, none))
            works.push_back(there.filename());
    }
    // Scripts first if a script is named, otherwise folders first: both may have the same name.
    std::ranges::sort(works, {},
                      [&](const fs::path& work) { return std::pair(is_script_name(work) != names_script, work); });
    for (const fs::path& work : works) words.push_back((is_script_name(work) ? work.stem() : work).string());
    auto found = works.end();
    if (const auto near = nearest_word(requested, words))
        found = works.begin() + (std::ranges::find(words, *near) - words.begin());
    else if (!requested.empty())  // "analysis (2).lua", as browsers name a second download
        found = std::ranges::find_if(works, [&](const fs::path& work) {
            return in_small_letters(work.string()).starts_with(in_small_letters(requested) + " ");
        });
    if (found == works.end()) return std::nullopt;
    return given.has_parent_path() ? given.parent_path() / *found : *found;
}

Message no_such_work(const fs::path& given) {
    const bool names_script = is_script_name(given);
    if (const auto near = nearest_work(given))
        return names_script
                   ? Message("file not found: {}; did you mean {}?", given.string(), shell_word(near->string()))
                   : Message("file or folder not found: {}; did you mean {}?", given.string(),
                             shell_word(near->string()));
    return names_script ? Message("file not found: {}", given.string())
                        : Message("file or folder not found: {}", given.string());
}

fs::path meant_script(const fs::path& given) {
    const bool folder = fs::is_directory(given);
    const fs::path script = folder ? given / kScriptOfFolder : given;
    if (fs::exists(script)) return script;
    if (!folder) throw EnvironmentError(no_such_work(given));
    const Message near = nearly_called(given, kScriptOfFolder);
    throw near.empty()
        ? EnvironmentError("the file {} is missing from the folder {}", kScriptOfFolder, given.string())
        : EnvironmentError("the file {} is missing from the folder {}, {}", kScriptOfFolder, given.string(), near);
}

std::string language_of_work(const std::filesystem::path& work) {
    std::error_code none;
    const bool folder = std::filesystem::is_directory(work, none);
    try {
        if (const auto report = work / "report.md"; folder && is_small_file(report)) {
            const auto metadata = read_template(report).metadata;
            if (const auto found = metadata.find("lang"); found != metadata.end()) return found->second;
        }
    } catch (const std::runtime_error&) {  // students write headers, too
    }
    try {
        if (const auto script = folder ? work / "analysis.lua" : work; is_small_file(script))
            return language_of_script(is_notebook(script) ? read_notebook(script).source : text_of_source(script));
    } catch (const std::runtime_error&) {
    }
    return "";
}

}  // namespace dynlab::inline workflow
