#include "workflow/student_copy.h"

#include <fmt/format.h>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/error.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/locks/complete_folder.h"
#include "platform/program_lookup.h"
#include "workflow/lesson_data.h"
#include "workflow/variant_data.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

std::string group_file(std::uint32_t seed, const std::string& language) {
    const Reader reader{catalog_of(language)};
    return fmt::format("# {}\nmembers = []        # {}\nseed = {}            # {}\n",
                       message_text(Message("Your group. Reports never show the contents of this file."), reader),
                       message_text(Message("for example [\"Ada Lovelace\", \"Rudolf Kalman\"]"), reader), seed,
                       message_text(Message("seed of your group's random numbers"), reader));
}

void put(std::string& text, const std::string& slot, const std::string& value) {
    const auto at = text.find(slot);
    if (at != std::string::npos) text.replace(at, slot.size(), value);
}

/// report_templates/slides.md, or slides.fr.md if the language has a separate template.
fs::path template_file(const std::string& name, const std::string& language) {
    const fs::path folder = shared_folder() / "report_templates", own = folder / (name + "." + language + ".md");
    return fs::is_regular_file(own) ? own : folder / (name + ".md");
}

/// The template's text with the lesson's title, language and (in answers to a lesson's questions) subtitle in its
/// header.
std::string report_for(const ScriptHeader& header, const fs::path& file, const std::string& language) {
    std::string text = read_text(file);
    const bool answers = header.template_name == "lesson" && !header.subtitle.empty();
    const std::string subtitle = answers ? "\nsubtitle: \"" + header.subtitle + "\"" : "";
    for (const char* title : {"title: My work", "title: Notre travail"})
        put(text, title, "title: \"" + header.title + "\"" + subtitle);
    put(text, "lang: en", "lang: " + (language.empty() ? header.language : language));
    return text;
}

void fill_lesson(const fs::path& folder, const Lesson& lesson, const std::optional<std::uint32_t>& group_seed,
                 const std::string& language) {
    const PercentScript script = lesson_script(lesson, language);
    write_file_atomically(folder / "analysis.lua",
                          without_solutions(script.source, script.file, script.header.language));
    const std::string form = script.header.template_name == "lesson" ? "exercise_sheet" : script.header.template_name;
    write_file_atomically(folder / "report.md", report_for(script.header, template_file(form, language), language));
    if (const fs::path literature = bibliography_of(script); !literature.empty())
        write_file_atomically(folder / literature.filename(), read_text(literature));
    for (const auto& entry : fs::directory_iterator(lesson.folder))
        if (entry.path().extension() == ".png") fs::copy_file(entry.path(), folder / entry.path().filename());
    write_file_atomically(folder / "group.toml",
                          group_file(group_seed.value_or(script.header.seed), script.header.language));
    const std::vector<std::string> own = group_seed ? simulated_data_of(lesson) : std::vector<std::string>();
    if (has_own_data(lesson)) copy_own_data(lesson, folder / "data");
    if (!own.empty())
        write_group_data(own, *group_seed, folder / "data");
    else if (!has_own_data(lesson))
        fs::create_directory_symlink(shared_folder() / "data", folder / "data");
}

void fill_review(const fs::path& folder, const std::string& language) {
    write_file_atomically(folder / "report.md", read_text(template_file("peer_review", language)));
    write_file_atomically(folder / "analysis.lua", read_text(shared_folder() / "report_templates" / "peer_review.lua"));
    write_file_atomically(folder / "group.toml", group_file(1, language));
}

std::vector<const Cell*> text_cells(const PercentScript& script) {
    std::vector<const Cell*> texts;
    for (const Cell& cell : script.cells)
        if (cell.kind == Cell::Kind::kText) texts.push_back(&cell);
    return texts;
}

/// Lines that end with one of these comments end with the comment behind it.
void translate_comments(std::vector<std::string>& lines, const std::vector<std::string>& comments) {
    for (std::string& line : lines)
        for (std::size_t i = 0; i + 1 < comments.size(); i += 2)
            if (comments[i].starts_with("-- ") && line.ends_with(comments[i]))
                line.replace(line.size() - comments[i].size(), comments[i].size(), comments[i + 1]);
}

}  // namespace

PercentScript lesson_script(const Lesson& lesson, const std::string& language) {
    const PercentScript script = read_percent_script(lesson.script());
    const fs::path file = lesson.tasks(language);
    if (language == script.header.language || !fs::is_regular_file(file)) return script;
    const PercentScript tasks = read_percent_script(file);
    std::string source = script.source;
    put(source, "-- title: " + script.header.title, "-- title: " + tasks.header.title);
    put(source, "-- subtitle: " + script.header.subtitle, "-- subtitle: " + tasks.header.subtitle);
    put(source, "-- language: " + script.header.language, "-- language: " + tasks.header.language);
    std::vector<std::string> lines = lines_of(source);
    const std::vector<const Cell*> texts = text_cells(script), translated = text_cells(tasks);
    if (texts.size() != translated.size())
        throw DocumentError(Message("{} has {} of text, but the lesson has {}", file.string(),
                                    plural(translated.size(), "{} cell", "{} cells"),
                                    plural(texts.size(), "{} cell", "{} cells")));
    for (std::size_t i = texts.size(); i-- > 0;) {
        const auto first = lines.begin() + texts[i]->first_line - 1;
        const auto after = lines.erase(first, lines.begin() + texts[i]->last_line());
        std::vector<std::string> text = lines_of(translated[i]->content);
        for (std::string& line : text) line.insert(0, line.empty() ? "--" : "-- ");
        lines.insert(after, text.begin(), text.end());
    }
    for (const Cell& cell : tasks.cells)
        if (cell.kind == Cell::Kind::kCode) translate_comments(lines, lines_of(cell.content));
    source.clear();
    for (const std::string& line : lines) source += line + "\n";
    return parse_percent_script(source, script.file);
}

void make_student_copy(const Lesson& lesson, const fs::path& folder, std::optional<std::uint32_t> group_seed,
                       const std::string& language, const std::function<void(const fs::path&)>& further) {
    make_complete_folder(folder, [&](const fs::path& growing) {
        fill_lesson(growing, lesson, group_seed, language);
        if (further) further(growing);
    });
}

void make_review_folder(const fs::path& folder, const std::string& language) {
    make_complete_folder(folder, [&](const fs::path& growing) { fill_review(growing, language); });
}

}  // namespace dynlab::inline workflow
