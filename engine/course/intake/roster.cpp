#include "course/intake/roster.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "course/intake/owners.h"
#include "data_io/tables/number_cell.h"
#include "data_io/text_table.h"
#include "platform/error.h"
#include "platform/text/read_number.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

/// What platforms call our columns, as words without accents, in the languages of universities that were looked at.
constexpr std::pair<const char*, std::string_view> kPlatformColumns[] = {
    {"id",
     "|id number|idnumber|id nummer|matrikelnummer|numero d identification|numero de id|numero d id|sis user "
     "id|student "
     "id|"},
    {"name", "|full name|vollstandiger name|nom complet|nombre completo|nome completo|volledige naam|student|"},
    {"first", "|first name|vorname|prenom|"},
    {"last", "|surname|last name|nachname|nom|nom de famille|"},
    {"group", "|groups|gruppe|gruppen|groupe|groupes|group name|"},
    {"email",
     "|email address|e mail address|e mail|e mail adresse|adresse de courriel|adresse e mail|correo "
     "electronico|direccion "
     "de correo|"},
    {"moodle", "|identifier|identifiant|identificador|identificatore|identificativo|teilnehmer in|"}};

/// Translates the header's platform names; what is there under our own name stays.
void translate_columns(TextTable& table) {
    const bool canvas = table.column("sis user id") && table.column("student");
    if (const auto id = table.column("id"); canvas && id) table.names[*id] = "canvas";
    for (std::string& name : table.names)
        if (const std::string ours = our_column(name); !table.column(ours)) name = ours;
}

}  // namespace

std::string digits_at_end(const std::string& text) {
    const std::size_t last = text.find_last_not_of("0123456789");
    return last == std::string::npos ? text : text.substr(last + 1);
}

std::string our_column(const std::string& header) {
    const std::string words = fmt::format("|{}|", fmt::join(name_words(header), " "));
    for (const auto& [ours, theirs] : kPlatformColumns)
        if (theirs.find(words) != std::string_view::npos) return ours;
    return in_small_letters(header);
}

std::vector<std::string> known_names_of(const Student& student) {
    std::vector<std::string> names;
    for (const std::string& name : {student.group, student.id, student.name})
        if (!name.empty()) names.push_back(name);
    return names;
}

Roster::Roster(const std::filesystem::path& file) {
    TextTable table = read_text_table(file);
    converted_ = table.converted;
    translate_columns(table);
    const auto id = table.column("id"), seed = table.column("seed");
    if (!id)
        throw EnvironmentError("{}: the column \"id\" is missing; the columns are {}", file.string(),
                               listed(table.names));
    columns_ = table.names;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        const auto fail = [&](const Message& what) {
            throw EnvironmentError("{}, line {}: {}", file.string(), table.lines[i], what);
        };
        const auto cell = [&](const char* column) {
            const auto index = table.column(column);
            return index ? row[*index] : std::string();
        };
        if (row[*id].empty() && cell("name") == "Points Possible") continue;  // Canvas's second line
        if (row[*id].empty()) fail(Message("the id is empty; fill in the column \"id\""));
        if (!seen.insert(row[*id]).second)
            fail(Message("the id \"{}\" occurs twice; give each student a different id", row[*id]));
        std::string name = cell("name");
        if (name.empty()) name = std::string(trimmed_cell(cell("first") + " " + cell("last")));
        Student student{row[*id],
                        name,
                        cell("group"),
                        {},
                        cell(table.column("email") ? "email" : "mail"),
                        digits_at_end(cell("moodle")),
                        cell("canvas")};
        if (seed && !row[*seed].empty()) {
            const std::string& text = row[*seed];
            student.seed = read_number<std::uint32_t>(text);
            if (student.seed.value_or(0) == 0)
                fail(Message("the seed must be a whole number from 1 to 4294967295, but \"{}\" was given", text));
        }
        student.language = cell("language");
        if (!student.language.empty() && student.language != "en" && student.language != "fr")
            fail(Message("the language must be en or fr, but \"{}\" was given", student.language));
        students_.push_back(std::move(student));
    }
}

bool Roster::has(const std::string& column) const {
    const auto there = [this](const char* name) { return std::ranges::find(columns_, name) != columns_.end(); };
    return columns_.empty() || there(column.c_str()) || (column == "mail" && there("email")) ||
           (column == "name" && (there("first") || there("last")));
}

std::vector<std::string> Roster::unknown_columns() const {
    static const std::set<std::string> known = {"id",    "name", "first",  "last",   "group",   "seed",
                                                "email", "mail", "moodle", "canvas", "language"};
    std::vector<std::string> unknown;
    for (const std::string& column : columns_)
        if (!known.contains(column)) unknown.push_back(column);
    return unknown;
}

}  // namespace dynlab::inline course
