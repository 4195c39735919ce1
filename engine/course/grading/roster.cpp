#include "course/grading/roster.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "data_io/text_table.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

/// Letters and digits in lower case: Canvas joins names, Moodle does not.
std::string bare(const std::string& text) {
    std::string result;
    for (const unsigned char c : text)
        if (std::isalnum(c) || c > 127) result += static_cast<char>(std::tolower(c));
    return result;
}

/// "Ada Lovelace" as "lovelaceada", as Canvas writes it.
std::string last_name_first(const std::string& name) {
    const auto blank = name.rfind(' ');
    return blank == std::string::npos ? bare(name) : bare(name.substr(blank + 1) + name.substr(0, blank));
}

}  // namespace

Roster::Roster(const std::filesystem::path& file) {
    const TextTable table = read_text_table(file);
    const auto id = table.column("id"), seed = table.column("seed");
    if (!id)
        throw EnvironmentError(
            fmt::format("{}: the column id is missing; there are {}", file.string(), fmt::join(table.names, ", ")));
    columns_ = table.names;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        const auto fail = [&](const std::string& what) {
            throw EnvironmentError(fmt::format("{}, line {}: {}", file.string(), table.lines[i], what));
        };
        if (row[*id].empty()) fail("the id is empty");
        if (!seen.insert(row[*id]).second) fail(fmt::format("the id \"{}\" occurs twice", row[*id]));
        const auto cell = [&](const char* column) {
            const auto index = table.column(column);
            return index ? row[*index] : std::string();
        };
        Student student{
            row[*id],       cell("name"),  cell("group"), {}, cell(table.column("email") ? "email" : "mail"),
            cell("moodle"), cell("canvas")};
        if (seed && !row[*seed].empty()) {
            const std::string& text = row[*seed];
            std::uint32_t number = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            if (error != std::errc() || end != text.data() + text.size() || number == 0)
                fail(fmt::format("the seed must be a whole number from 1 to 4294967295, but \"{}\" was given", text));
            student.seed = number;
        }
        students_.push_back(std::move(student));
    }
}

bool Roster::has(const std::string& column) const {
    const auto there = [this](const char* name) {
        return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
    };
    return columns_.empty() || there(column.c_str()) || (column == "mail" && there("email"));
}

std::vector<std::string> Roster::unknown_columns() const {
    static const std::set<std::string> known = {"id", "name", "group", "seed", "email", "mail", "moodle", "canvas"};
    std::vector<std::string> unknown;
    for (const std::string& column : columns_)
        if (!known.contains(column)) unknown.push_back(column);
    return unknown;
}

std::vector<std::size_t> Roster::owners(const Submission& submission) const {
    const auto those = [&](const auto& fits) {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < students_.size(); ++i)
            if (fits(students_[i])) found.push_back(i);
        return found;
    };
    const std::string own = submission.person.empty() ? submission.name : submission.person;
    std::vector<std::size_t> found = those([&](const Student& s) { return !s.group.empty() && s.group == own; });
    if (found.empty())
        found = those([&](const Student& s) {
            const std::string& number = submission.lms_id;
            return s.id == own || (!number.empty() && (s.id == number || s.moodle == number || s.canvas == number));
        });
    if (found.empty() && !bare(own).empty())
        found =
            those([&](const Student& s) { return bare(s.name) == bare(own) || last_name_first(s.name) == bare(own); });
    if (found.empty() || found.size() > 1)  // two students of the same name cannot be told apart
        return !found.empty() && students_[found.front()].group.empty() ? std::vector<std::size_t>{} : found;
    // What one member hands in is the group's.
    const std::string& group = students_[found.front()].group;
    return group.empty() ? found : those([&](const Student& s) { return s.group == group; });
}

}  // namespace dynlab::inline course
