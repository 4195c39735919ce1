#include "course/export/platform_sheet.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <functional>
#include <set>

#include "base/reader.h"
#include "course/grading/feedback.h"
#include "course/intake/owners.h"
#include "data_io/tables/number_cell.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/foreign_text.h"
#include "platform/text/small_letters.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

/// Headers as words without accents and case, in the languages of universities that were looked at: English, French,
/// German, Spanish, Catalan, Italian, Portuguese, Dutch.
constexpr const char* kGradeHeaders[] = {"grade",         "note",        "bewertung", "calificacion",
                                         "qualificacio",  "valutazione", "voto",      "nota",
                                         "classificacao", "avaliacao",   "cijfer",    "beoordeling"};
/// Beginnings of a word of the header.
constexpr const char* kMaximumWords[] = {"maxim", "maximal", "bestwertung", "massim", "maxima"};
constexpr const char* kCommentWords[] = {"comment", "kommentar", "comentari", "opmerking", "retroaliment"};

std::string words_of_header(const std::string& text) {
    return fmt::format("{}", fmt::join(name_words(text), " "));
}

template <std::size_t n>
bool is_known_header(const std::string& words, const char* const (&known)[n]) {
    return std::find(std::begin(known), std::end(known), words) != std::end(known);
}

template <std::size_t n>
bool has_word(const std::string& words, const char* const (&beginnings)[n]) {
    return std::any_of(std::begin(beginnings), std::end(beginnings), [&](const char* beginning) {
        return words.starts_with(beginning) || words.find(std::string(" ") + beginning) != std::string::npos;
    });
}

std::optional<std::size_t> first_column(const std::vector<std::string>& names,
                                        const std::function<bool(const std::string&)>& fits) {
    const auto found = std::find_if(names.begin(), names.end(), fits);
    if (found == names.end()) return {};
    return static_cast<std::size_t>(found - names.begin());
}

std::string without_quotes(const std::string& cell) {
    const std::string_view text = trimmed_cell(cell);
    if (text.size() < 2 || text.front() != '"') return std::string(text);
    std::string value;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        value += text[i];
        if (text[i] == '"') ++i;
    }
    return value;
}

/// "Participant 900001", "Teilnehmer/in900001": a word and a number.
bool is_participant(const std::string& cell) {
    static const RE2 kForm(R"(\pL[^\d]*\d+)");
    return RE2::FullMatch(cell, kForm);
}

}  // namespace

PlatformSheet::PlatformSheet(const std::filesystem::path& file, const std::string& assignment) : file_(file) {
    std::string text = read_file(file);
    if (text.starts_with("\xEF\xBB\xBF")) mark_ = text.substr(0, 3), text.erase(0, 3);
    if (text.find('\0') != std::string::npos)
        throw EnvironmentError("{}: the file is not UTF-8 text; download it as CSV", file.string());
    if (!is_utf8(text)) text = utf8_of_windows_1252(text);
    split(text);
    if (lines_.empty()) throw EnvironmentError("{}: the file is empty; download it again", file.string());
    for (const std::string& cell : lines_.front().cells) names_.push_back(words_of_header(without_quotes(cell)));
    if (names_.size() > 1 && names_[1] == "id")
        recognize_canvas(assignment);
    else
        recognize_moodle();
    find_people();
}

void PlatformSheet::split(std::string_view text) {
    const std::string_view header = text.substr(0, text.find('\n'));
    for (const char c : {';', '\t'})
        if (std::ranges::count(header, c) > std::ranges::count(header, separator_)) separator_ = c;
    Line line;
    std::string cell;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        if (quoted || (c != separator_ && c != '\n')) {
            cell += c;
            continue;
        }
        if (c == '\n' && cell.ends_with('\r')) cell.pop_back(), line.end = "\r";
        line.cells.push_back(std::exchange(cell, {}));
        if (c != '\n') continue;
        line.end += '\n';
        lines_.push_back(std::exchange(line, {}));
    }
    if (quoted) throw EnvironmentError("{}: a quotation mark is not closed; download the file again", file_.string());
    if (cell.empty() && line.cells.empty()) return;
    line.cells.push_back(std::move(cell));
    lines_.push_back(std::move(line));
}

std::string PlatformSheet::value(std::size_t row, std::optional<std::size_t> column) const {
    return column ? without_quotes(lines_[row].cells[*column]) : std::string();
}

std::vector<std::size_t> PlatformSheet::rows() const {
    std::vector<std::size_t> all;
    for (std::size_t i = 1; i < lines_.size(); ++i)
        if (lines_[i].cells.size() == names_.size()) all.push_back(i);
    return all;
}

/// The only one whose cells are all the same number, behind a column that can hold grades.
std::optional<std::size_t> PlatformSheet::maximum_column() const {
    const std::vector<std::size_t> all = rows();
    std::vector<std::size_t> found;
    for (std::size_t column = 1; column < names_.size() && !all.empty(); ++column) {
        const std::string first = value(all.front(), column);
        const bool fits = std::ranges::all_of(all, [&](std::size_t row) {
            const std::string grade = value(row, column - 1);
            return value(row, column) == first && (grade.empty() || number_in_cell(grade));
        });
        if (fits && number_in_cell(first).value_or(0) > 0) found.push_back(column);
    }
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

std::string PlatformSheet::listed_columns() const {
    std::vector<std::string> names;
    for (const std::string& cell : lines_.front().cells) names.push_back(without_quotes(cell));
    return message_text(Message("{}", listed(names)));
}

void PlatformSheet::recognize_moodle() {
    const std::vector<std::size_t> all = rows();
    const auto holds_participants = [&](std::size_t column) {
        return !all.empty() &&
               std::ranges::all_of(all, [&](std::size_t row) { return is_participant(value(row, column)); });
    };
    const auto called = [this](const std::string& ours) {
        return first_column(names_, [&](const std::string& name) { return our_column(name) == ours; });
    };
    number_ = called("moodle");
    for (std::size_t i = 0; i < names_.size() && !number_; ++i)
        if (holds_participants(i)) number_ = i;
    if (!number_)
        throw EnvironmentError(
            "{}: expected Moodle's grading worksheet (a column such as \"Identifier\" with entries such as "
            "\"Participant 12\") or Canvas's gradebook (second column \"ID\"); the columns are {}",
            file_.string(), listed_columns());
    const auto maximum = [&] {
        const auto named = first_column(names_, [](const std::string& name) { return has_word(name, kMaximumWords); });
        return named ? named : maximum_column();
    }();
    grade_ = first_column(names_, [](const std::string& name) { return is_known_header(name, kGradeHeaders); });
    maximum_ = maximum;
    if (!grade_ && maximum && *maximum > 0) grade_ = *maximum - 1;
    if (!grade_ || grade_ == number_)
        throw EnvironmentError(
            "{}: a column for grades, such as \"Grade\", is required; the columns are {}. Download the worksheet with "
            "Moodle in English",
            file_.string(), listed_columns());
    id_ = called("id"), mail_ = called("email"), name_ = called("name");
    comment_ = first_column(names_, [](const std::string& name) { return has_word(name, kCommentWords); });
    if (!name_ && *number_ + 1 < names_.size() && grade_ != *number_ + 1) name_ = *number_ + 1;
    if (!comment_)
        unrecognized_.push_back(Message(
            "{}: the column for feedback comments is not recognized; the comments are left out", file_.string()));
    for (const std::size_t row : all)
        for (const auto column : {grade_, maximum})
            decimal_comma_ = decimal_comma_ || value(row, column).find(',') != std::string::npos;
}

void PlatformSheet::recognize_canvas(const std::string& assignment) {
    static const RE2 kAssignment(R"((.*\S)\s*\(\d+\))");
    platform_ = Platform::kCanvas;
    name_ = 0, number_ = 1;
    for (std::size_t i = 2; i < names_.size(); ++i)
        if (names_[i].starts_with("sis ") || names_[i].ends_with(" sis")) (id_ ? mail_ : id_) = i;
    std::vector<std::size_t> fitting, all;
    for (std::size_t i = 2; i < names_.size(); ++i) {
        const std::string header = value(0, i);
        std::string plain;
        if (!RE2::FullMatch(header, kAssignment, &plain)) continue;
        all.push_back(i);
        if (header == assignment || plain == assignment) fitting.push_back(i);
    }
    if (assignment.empty()) fitting = all;
    if (fitting.size() != 1)
        throw EnvironmentError(
            "{}: specify the column to fill in (--assignment of dynlab export-grades, --column of dynlab course "
            "export); the columns are {}",
            file_.string(), listed_columns());
    grade_ = fitting.front();
}

void PlatformSheet::find_people() {
    for (const std::size_t row : rows()) {
        Person person{row, value(row, number_), value(row, id_), value(row, mail_), value(row, name_)};
        if (platform_ == Platform::kMoodle) person.number = digits_at_end(person.number);
        if (!person.number.empty()) people_.push_back(std::move(person));  // not "Points Possible"
    }
}

void PlatformSheet::put(std::size_t row, std::size_t column, const std::string& text) {
    const bool separated = text.find(separator_) != std::string::npos;
    lines_[row].cells[column] = number_in_cell(text) && !separated ? text : csv_cell(text);
}

std::optional<double> PlatformSheet::maximum() const {
    for (const std::size_t row : rows()) {
        const bool has_it = platform_ == Platform::kMoodle ? maximum_.has_value() : value(row, number_).empty();
        if (has_it) return number_in_cell(value(row, platform_ == Platform::kMoodle ? maximum_ : grade_));
    }
    return {};
}

void PlatformSheet::set_grade(const Person& person, const std::string& points) {
    std::string text = points;
    if (decimal_comma_) std::replace(text.begin(), text.end(), '.', ',');
    put(person.row, *grade_, text);
}

void PlatformSheet::set_comment(const Person& person, const std::string& comment) {
    if (comment_) put(person.row, *comment_, comment);
}

std::string PlatformSheet::text() const {
    std::string text = mark_;
    for (const Line& line : lines_)
        text += fmt::format("{}{}", fmt::join(line.cells, std::string(1, separator_)), line.end);
    return text;
}

std::map<std::size_t, PlatformSheet::Person> rows_of(const PlatformSheet& sheet,
                                                     const std::vector<SoughtPerson>& sought) {
    const std::vector<PlatformSheet::Person>& people = sheet.people();
    std::map<std::size_t, PlatformSheet::Person> rows;
    std::set<std::size_t> taken;
    const auto match = [&](const auto& fits) {
        std::map<std::size_t, std::vector<std::size_t>> students, found;  // by row; rows by student
        for (std::size_t row = 0; row < people.size(); ++row)
            for (std::size_t i = 0; i < sought.size() && !taken.contains(row); ++i)
                if (fits(people[row], sought[i])) students[row].push_back(i);
        for (const auto& [row, fitting] : students)
            if (fitting.size() == 1 && !rows.contains(fitting.front())) found[fitting.front()].push_back(row);
        for (const auto& [student, fitting] : found)
            if (fitting.size() == 1) rows[student] = people[fitting.front()], taken.insert(fitting.front());
    };
    const auto same = [](const std::string& a, const std::string& b) { return !a.empty() && a == b; };
    match([&](const PlatformSheet::Person& row, const SoughtPerson& one) { return same(row.id, one.id); });
    match([&](const PlatformSheet::Person& row, const SoughtPerson& one) {
        return same(in_small_letters(row.mail), in_small_letters(one.mail));
    });
    match([&](const PlatformSheet::Person& row, const SoughtPerson& one) { return same(row.number, one.number); });
    match([](const PlatformSheet::Person& row, const SoughtPerson& one) { return same_person(one.name, row.name); });
    return rows;
}

std::string points_in_sheet(const PlatformSheet& sheet, double points, double possible) {
    const double maximum = sheet.maximum().value_or(possible);
    return points_text(possible > 0 ? points * maximum / possible : points);
}

}  // namespace dynlab::inline course
