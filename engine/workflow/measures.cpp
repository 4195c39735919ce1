#include "workflow/measures.h"

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/text/small_letters.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline workflow {

std::map<std::string, std::string> measures_for_documents(const std::string& language) {
    const std::filesystem::path own = shared_folder() / "report_templates" / ("measures." + language + ".md");
    const std::string source =
        std::filesystem::is_regular_file(own) ? read_text(own) : std::string(find_help_page("measures")->text);
    std::map<std::string, std::string> measures;
    std::string* current = nullptr;
    for (const std::string& line : lines_of(source)) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("## ") && colon != std::string::npos) {
            const std::string key = in_small_letters(line.substr(3, colon - 3));
            current = &measures[key];
            *current = "### " + line.substr(colon + 2) + " {.unnumbered}\n";
        } else if (current) {
            *current += line + "\n";
        }
    }
    return measures;
}

}  // namespace dynlab::inline workflow
