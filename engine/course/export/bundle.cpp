#include "course/export/bundle.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "base/languages.h"
#include "base/reader.h"
#include "course/intake/folder_copy.h"
#include "data_io/dataset_index.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/zip_file.h"
#include "platform/keys/secure_random.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"
#include "workflow/student_copy.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// What the students read first, in their language.
std::string readme_of(const Lesson& lesson, const BundleOptions& options) {
    const PercentScript script = lesson_script(lesson, options.language);
    const Reader reader{catalog_of(options.language.empty() ? script.header.language : options.language)};
    std::vector<Message> lines = {
        Message::verbatim("# " + script.header.title + "\n"),
        Message("Install dynlab once with the package that the course provides (sudo apt install ./dynlab_*.deb). Then "
                "open a terminal in the folder that contains {}:",
                lesson.slug),
        Message::verbatim("")};
    for (const char* command : {"run", "check", "report", "pack"})
        lines.push_back(Message::verbatim(fmt::format("    dynlab {} {}", command, lesson.slug)));
    lines.push_back(Message::verbatim(""));
    lines.push_back(
        Message("Write your analysis in analysis.lua and your text in report.md. Submit the zip file that dynlab pack "
                "creates."));
    if (!options.sheet.empty()) lines.push_back(Message("The tasks are in {}.", options.sheet.filename().string()));
    lines.push_back(Message("To read the first page of the manual, run: dynlab help guide-first-hour"));
    std::string text;
    for (const Message& line : lines) text += message_text(line, reader) + "\n";
    return text;
}

std::uint32_t drawn_seed(std::set<std::uint32_t>& taken) {
    constexpr std::size_t kMax = 999'999;
    while (true) {
        const auto seed = static_cast<std::uint32_t>(secure_below(kMax)) + 1;
        if (taken.insert(seed).second) return seed;
    }
}

const std::string& bundle_owner(const Student& student) {
    return student.group.empty() ? student.id : student.group;
}

void take_seeds(const std::vector<Student>& students, std::map<std::string, std::uint32_t>& seeds) {
    for (const Student& student : students) {
        if (!student.seed) continue;
        const auto [known, added] = seeds.try_emplace(bundle_owner(student), *student.seed);
        if (!added && known->second != *student.seed)
            throw EnvironmentError("the members of {} have different seeds; give them the same seed in the roster",
                                   bundle_owner(student));
    }
}

}  // namespace

std::vector<std::string> bundle_lesson(const Lesson& lesson, const fs::path& file, const BundleOptions& options) {
    const TemporaryFolder work;
    const fs::path starter = work.path() / lesson.slug;
    make_student_copy(lesson, starter, options.group_seed, options.language);
    std::map<std::string, std::string> contents;
    const auto add = [&](const std::string& name, std::string content) {
        contents[lesson.slug + "/" + name] = std::move(content);
    };
    for (auto& [name, content] : contents_of(starter)) add(name, content);
    if (fs::exists(lesson.folder / "checks.lua")) add("checks.lua", read_file(lesson.folder / "checks.lua"));
    // Beside the folder, of which students make their pack.
    if (!options.sheet.empty()) contents[options.sheet.filename().string()] = read_file(options.sheet);
    contents[lesson.slug + "_README.md"] = readme_of(lesson, options);
    const std::string script = read_file(lesson.script());
    for (const std::string& data_set : dataset_names()) {
        const bool own =
            fs::is_directory(fs::symlink_status(starter / "data")) && fs::exists(starter / "data" / data_set);
        if (own || script.find("load(\"" + data_set + "\")") == std::string::npos) continue;
        for (auto& [name, content] : contents_of(shared_folder() / "data" / data_set))
            add("data/" + data_set + "/" + name, content);
    }
    write_zip(file, contents);
    std::vector<std::string> names;
    for (const auto& [name, content] : contents) names.push_back(name);
    return names;
}

std::vector<BundleOwner> bundle_owners(std::vector<Student>& students, const std::vector<Student>& earlier) {
    std::map<std::string, std::uint32_t> seeds, before;
    take_seeds(students, seeds);
    take_seeds(earlier, before);
    seeds.merge(before);
    std::set<std::uint32_t> taken;
    for (const auto& [owner, seed] : seeds) taken.insert(seed);
    std::vector<BundleOwner> owners;
    std::map<std::string, std::size_t> places;
    for (Student& student : students) {
        const std::string& name = bundle_owner(student);
        if (name.find('/') != std::string::npos || terminal_line(name) != name)
            throw EnvironmentError(
                "\"{}\" is not a valid file name: it contains / or invisible characters. Correct the roster",
                terminal_line(name));
        const auto known = seeds.find(name);
        student.seed = known == seeds.end() ? seeds[name] = drawn_seed(taken) : known->second;
        const auto [place, added] = places.try_emplace(name, owners.size());
        if (added) owners.push_back({name, student.language, *student.seed});
        if (owners[place->second].language.empty()) owners[place->second].language = student.language;
    }
    return owners;
}

std::string roster_text(const std::vector<Student>& students) {
    TextTable table;
    table.names = {"id", "name", "group", "seed", "mail", "moodle", "canvas", "language"};
    for (const Student& s : students)
        table.rows.push_back(
            {s.id, s.name, s.group, s.seed ? std::to_string(*s.seed) : "", s.mail, s.moodle, s.canvas, s.language});
    return csv_text(table);
}

}  // namespace dynlab::inline course
