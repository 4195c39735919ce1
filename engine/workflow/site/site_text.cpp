#include "workflow/site/site_text.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <functional>
#include <set>

#include "documents/text_lines.h"
#include "numerics/estimators/method_catalog.h"
#include "platform/atomic_file.h"
#include "platform/text/small_letters.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "workflow/demonstration.h"
#include "workflow/lesson_catalog.h"
#include "workflow/site/table_columns.h"

namespace dynlab::inline workflow {
namespace {

/// Letters, digits and hyphens of a heading.
std::string id_of(const std::string& heading) {
    std::string id;
    for (const char c : in_small_letters(heading)) {
        if (std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 0x80)
            id += c;
        else if (!id.empty() && id.back() != '-')
            id += '-';
    }
    while (id.ends_with('-')) id.pop_back();
    return id;
}

bool is_heading(const std::string& line) {
    const std::size_t marks = line.find_first_not_of('#');
    return marks != 0 && marks != std::string::npos && marks < 5 && line[marks] == ' ';
}

std::string domain_of(TimeDomain domain) {
    return domain == TimeDomain::kContinuous ? "continuous" : domain == TimeDomain::kDiscrete ? "discrete" : "none";
}

/// The page behind the others, its headings (of which one is the first) rewritten.
void append_page(const SiteText& page, MarkdownText& all,
                 const std::function<std::string(const std::string&, bool)>& rewritten) {
    FencedCode code;
    int number = 0;
    bool first = true;
    for (const std::string& line : lines_of(page.markdown.text)) {
        ++number;
        const bool heading = !code.holds(line) && is_heading(line);
        all.text += (heading ? rewritten(line, first) : line) + "\n";
        all.origin.push_back(page.markdown.origin_of(number));
        if (heading) first = false;
    }
    all.text += "\n";
    all.origin.push_back({});
}

/// The lessons and demonstrations whose scripts call one of the functions, as "06_physics, 08_frequency"; names of
/// files.
std::string places_that_teach(const std::vector<std::string>& functions) {
    const std::string names = fmt::format("{}", fmt::join(functions, "|"));
    const RE2 call("(^|[^A-Za-z_0-9.:])(" + names + ")[({]", RE2::Latin1);
    std::string places;
    const auto look = [&](const std::string& name, const std::filesystem::path& script) {
        if (RE2::PartialMatch(read_text(script), call)) places += (places.empty() ? "" : ", ") + name;
    };
    for (const Lesson& lesson : lessons()) look(lesson.slug, lesson.script());
    for (const Demonstration& demonstration : demonstrations()) look(demonstration.script.stem(), demonstration.script);
    return places.empty() ? "the example on its page" : places;
}

const FunctionEntry* entry_of(const std::string& name) {
    for (const FunctionEntry& entry : catalog_of_functions())
        if (entry.name == name) return &entry;
    return nullptr;
}

/// The place of the first function of the area in the catalog.
std::size_t place_of_area(const std::string& area) {
    const auto& all = catalog_of_functions();
    return static_cast<std::size_t>(std::ranges::find(all, area, &FunctionEntry::area) - all.begin());
}

std::string with_capital(std::string text) {
    const std::size_t letter = text.starts_with('`') ? text.size() : 0;
    if (letter < text.size()) text[letter] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[letter])));
    return text;
}

/// The third line of a guide is "guide: what it is about".
bool says_its_subject(const HelpPage& page) {
    return page.text.find("\n\nguide: ") != std::string_view::npos ||
           page.text.find("\n\nsubject: ") != std::string_view::npos;
}

/// A guide under the title of its subject; the command that shows the guide contains its name.
MarkdownText headed_guide(const HelpPage& page, const MarkdownText& text) {
    if (!says_its_subject(page)) return text;
    MarkdownText headed;
    std::size_t number = 0;
    for (const std::string& line : lines_of(text.text)) {
        const Place origin = text.origin_of(static_cast<int>(++number));
        headed.text += number == 1   ? "# " + title_of_guide(page)
                       : number == 3 ? fmt::format("In a terminal: `dynlab help {}`.", page.name)
                                     : line;
        headed.text += "\n";
        headed.origin.push_back(origin);
    }
    return headed;
}

}  // namespace

std::vector<SiteText> help_texts(const HelpExamples& examples) {
    std::vector<SiteText> guides, functions;
    for (const HelpPage& page : help_pages()) {
        const std::string name(page.name);
        const PercentScript& script = examples.pages.at(name);
        const FunctionEntry* entry = entry_of(name);
        MarkdownText text = weave_cells(script, examples.record);
        text.text = with_fitted_columns(text.text);
        if (entry)
            functions.push_back({name, entry->area, text});
        else
            guides.push_back({name, "Guides", headed_guide(page, text)});
    }
    std::stable_partition(guides.begin(), guides.end(),
                          [](const SiteText& guide) { return guide.name == "guide-first-hour"; });
    std::ranges::stable_sort(
        functions, [](const SiteText& a, const SiteText& b) { return place_of_area(a.part) < place_of_area(b.part); });
    guides.insert(guides.end(), functions.begin(), functions.end());
    return guides;
}

std::string title_of_guide(const HelpPage& page) {
    if (!says_its_subject(page)) return std::string(page.name);
    return with_capital(subject_of(page));
}

std::string beginning_of(std::string_view help_page) {
    const std::string text(help_page);
    const std::size_t begin = text.find("\n\n");  // behind the title
    if (begin == std::string::npos) return "";
    return trimmed(text.substr(begin, text.find("\n## ", begin) - begin));
}

SiteText methods_text() {
    SiteText methods{"methods", "", {}};
    std::string text =
        "# Methods\n\nEvery method of dynlab: the model, the assumption about the noise, and the source. The pages of "
        "the functions describe options, results and errors.\n\n";
    for (const MethodEntry& method : method_catalog()) {
        std::string title = method.title, names;
        title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
        for (const std::string& name : method.lua_names) names += (names.empty() ? "`" : ", `") + name + "`";
        const auto page = find_help_page(method.lua_names.front());
        text += fmt::format("## {}\n\n{}\n\n", title, page ? beginning_of(page->text) : "");
        text += fmt::format(
            "- functions: {}\n- model: `{}`\n- time: {}\n- noise: {}\n- taught in: {}\n- literature: {}\n- source: "
            "`engine/numerics/estimators/{}.h`\n\n",
            names, method.structure, domain_of(method.domain), method.noise, places_that_teach(method.lua_names),
            method.reference, method.file);
    }
    methods.markdown.append(text, "catalog.cpp", 1);
    return methods;
}

MarkdownText joined_pages(const std::vector<SiteText>& texts) {
    MarkdownText all;
    std::set<std::string> ids;
    for (const SiteText& page : texts) {
        const std::string page_id = id_of(page.name);
        append_page(page, all, [&](const std::string& heading, bool first) {
            std::string id = first ? page_id : page_id + "-" + id_of(heading);
            for (int further = 2; !ids.insert(id).second; ++further)
                id = fmt::format("{}-{}-{}", page_id, id_of(heading), further);
            return heading + " {#" + id + "}";
        });
    }
    return all;
}

}  // namespace dynlab::inline workflow
