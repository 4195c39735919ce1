#include "workflow/given_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "platform/error.h"
#include "platform/files/inside_folder.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScriptOfFolder = "analysis.lua";

/// What lies beside scripts and is given in their place. Scripts may have any other ending, or none.
constexpr std::pair<const char*, const char*> kKinds[] = {
    {".md", "a text in Markdown"}, {".pdf", "a PDF"},
    {".csv", "a table of data"},   {".mat", "a file of data"},
    {".txt", "a plain text"},      {".html", "a page"},
    {".json", "a JSON file"},      {".toml", "a file of settings"},
    {".bib", "a bibliography"},    {".zip", "an archive"},
    {".gz", "an archive"},         {".tgz", "an archive"},
    {".png", "a picture"},         {".jpg", "a picture"},
    {".jpeg", "a picture"},        {".svg", "a picture"},
    {".tex", "a text in LaTeX"},   {".docx", "a document"},
    {".odt", "a document"},        {".xlsx", "a table of data"},
};

}  // namespace

std::string why_no_script(const fs::path& given, const std::string& command) {
    const std::string ending = ending_of(given), name = given.filename().string();
    const auto kind =
        std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& one) { return ending == one.first; });
    std::error_code none;
    if (kind == std::end(kKinds) || !fs::is_regular_file(given, none)) return "";
    const fs::path folder = folder_around(given);
    if (!fs::is_regular_file(folder / kScriptOfFolder, none))
        return fmt::format("{} is {}: give a script (.lua) or a notebook (.ipynb)", name, kind->second);
    const bool report = in_small_letters(name) == "report.md" || in_small_letters(name) == "report.pdf";
    return fmt::format("{} is {}: give the folder, dynlab {} {}", name,
                       !report           ? kind->second
                       : ending == ".md" ? "the report's text"
                                         : "the report's PDF",
                       command, shell_word(folder.string()));
}

std::string nearly_called(const fs::path& folder, const std::string& name) {
    const std::string wanted = in_small_letters(name), ending = ending_of(name);
    const std::string stem = wanted.substr(0, wanted.size() - ending.size());
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
                   ? fmt::format(", but {0}.ipynb: give that file", stem)
                   : "";
    std::sort(near.begin(), near.end());
    constexpr std::size_t kMost = 3;
    near.resize(std::min(near.size(), kMost));
    return fmt::format(", but {}: call it {}", fmt::join(near, ", "), name);
}

fs::path meant_script(const fs::path& given) {
    const bool folder = fs::is_directory(given);
    const fs::path script = folder ? given / kScriptOfFolder : given;
    if (fs::exists(script)) return script;
    const std::string near = nearly_called(folder_around(script), script.filename().string());
    if (folder)
        throw EnvironmentError(fmt::format("there is no {} in the folder {}{}", kScriptOfFolder, given.string(), near));
    if (!near.empty()) throw EnvironmentError(fmt::format("there is no file {}{}", given.string(), near));
    return script;  // whoever reads it tells what is wrong with it
}

}  // namespace dynlab::inline workflow
