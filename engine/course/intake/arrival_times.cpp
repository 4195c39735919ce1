#include "course/intake/arrival_times.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "base/reader.h"
#include "course/intake/owners.h"
#include "course/intake/roster.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

constexpr Instant kYear2000 = 946684800;

/// Beginnings of Moodle's header "Last modified (submission)", without accents and brackets, in English, French,
/// German, Spanish, Catalan, Italian, Portuguese and Dutch. "Last modified (grade)" begins alike.
constexpr const char* kModified[] = {"last modified",       "derniere modification", "zuletzt geandert",
                                     "ultima modificacion", "darrera modificacio",   "ultima modifica",
                                     "ultima modificacao",  "laatst gewijzigd"};
constexpr const char* kOfGrade[] = {"grade",        "note",        "bewertung", "calificacion",
                                    "qualificacio", "valutazione", "nota",      "cijfer"};

/// "Participant 900010", "Teilnehmer/in900010": the number is that in the names of Moodle's folders.
std::string key_in(const std::string& cell) {
    static const RE2 kParticipant(R"((?:[Pp]articip|[Tt]eilnehm|[Dd]eelnem)[^\d]*(\d+))");
    std::string number;
    return in_small_letters(RE2::FullMatch(cell, kParticipant, &number) ? number : cell);
}

/// Names of months without accents, in the languages of kModified other than English.
constexpr std::string_view kMonths[] = {" janvier januar enero gener gennaio janeiro januari ",
                                        " fevrier februar febrero febrer febbraio fevereiro februari ",
                                        " mars marz marzo marc marco maart ",
                                        " avril april abril aprile ",
                                        " mai mayo maig maggio maio mei ",
                                        " juin juni junio juny giugno junho ",
                                        " juillet juli julio juliol luglio julho ",
                                        " aout august agosto agost augustus ",
                                        " septembre september septiembre setembre settembre setembro ",
                                        " octobre oktober octubre ottobre outubro ",
                                        " novembre november noviembre novembro ",
                                        " decembre dezember diciembre desembre dicembre dezembro december "};

/// "vendredi 27 février 2026, 17:30" as "2026-2-27 17:30"; empty where it is no such time.
std::string in_figures(const std::string& text) {
    static const RE2 kForm(R"((?:\pL+,? )?(\d{1,2})\.? (?:d[e'’] ?)?(\pL+) (?:de[l]? )?(\d{4}),? (\d{1,2}:\d{2}))");
    std::string day, name, year, time;
    if (!RE2::FullMatch(text, kForm, &day, &name, &year, &time)) return "";
    const std::string word = fmt::format(" {} ", fmt::join(name_words(name), ""));
    for (std::size_t month = 0; month < std::size(kMonths); ++month)
        if (kMonths[month].find(word) != std::string_view::npos)
            return fmt::format("{}-{}-{} {}", year, month + 1, day, time);
    return "";
}

bool is_time_of_submission(const std::string& header) {
    const std::vector<std::string> words = name_words(header);
    const std::string plain = fmt::format("{}", fmt::join(words, " "));
    const bool modified =
        std::ranges::any_of(kModified, [&](const char* beginning) { return plain.starts_with(beginning); });
    return modified && std::ranges::find(kOfGrade, words.back()) == std::end(kOfGrade);
}

/// Also as Moodle writes times in English: "Friday, 27 February 2026, 5:30 PM", and in other languages: a day, the name
/// of a month, a year and a time.
Instant time_in(const std::string& text) {
    const bool utc = text.ends_with('Z');
    auto read = plain_clock_reading(utc ? text.substr(0, text.size() - 1) : text, utc);
    if (!read) read = clock_reading(text, {"%A, %d %B %Y, %I:%M %p", "%d %B %Y, %I:%M %p", "%A, %d %B %Y, %H:%M"});
    if (!read) read = plain_clock_reading(in_figures(text));
    if (!read)
        throw InvalidArgument("the time must have a form such as \"2026-03-01 18:00\", but \"{}\" was given", text);
    if (!read->exists)
        throw InvalidArgument("the time \"{}\" does not exist in the course's time zone; correct the time", text);
    return read->instant;
}

}  // namespace

ArrivalTimes::ArrivalTimes(const std::filesystem::path& csv) {
    const TextTable table = read_text_table(csv);
    std::vector<std::size_t> whose;
    static const std::set<std::string> kWhose = {"moodle", "id", "group", "name", "email", "mail"};
    for (std::size_t i = 0; i < table.names.size(); ++i)
        if (kWhose.contains(our_column(table.names[i]))) whose.push_back(i);
    std::optional<std::size_t> when;
    for (const char* name : {"time", "received", "submitted_at"})
        if (const auto column = table.column(name); column && !when) when = column;
    for (std::size_t i = 0; i < table.names.size() && !when; ++i)
        if (is_time_of_submission(table.names[i])) when = i;
    if (whose.empty() || !when)
        throw EnvironmentError(
            "{}: a column \"identifier\", \"id\", \"group\", \"name\" or \"mail\", and a column \"last modified "
            "(submission)\", \"time\" or \"received\", are required; the columns are {}",
            csv.string(), listed(table.names));
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const std::string& text = table.rows[r][*when];
        if (text.empty() || text == "-") continue;
        try {
            const Instant time = time_in(text);
            for (const std::size_t column : whose)
                if (const std::string& key = table.rows[r][column]; !key.empty()) times_[key_in(key)] = time;
        } catch (const InvalidArgument& error) {
            throw EnvironmentError("{}, line {}: {}", csv.string(), table.lines[r], message_of(error));
        }
    }
}

std::optional<Instant> ArrivalTimes::of(const Submission& submission, const std::vector<std::string>& also) const {
    std::vector<std::string> keys = {submission.lms_id, submission.person, submission.name};
    keys.insert(keys.end(), also.begin(), also.end());
    for (const std::string& key : keys)
        if (const auto found = times_.find(in_small_letters(key)); !key.empty() && found != times_.end())
            return found->second;
    return {};
}

std::optional<Instant> time_in_archive(const std::filesystem::path& file) {
    const auto written = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(file));
    const Instant time = std::chrono::duration_cast<std::chrono::seconds>(written.time_since_epoch()).count();
    if (time < kYear2000) return {};
    return time;
}

Message doubt_about_zone(std::vector<std::int64_t> late, std::size_t files) {
    constexpr std::int64_t kWidestZone = 14 * 3600;
    constexpr std::size_t kMinCount = 3;
    std::ranges::sort(late);
    if (files < kMinCount || 10 * late.size() < 9 * files || late.back() > kWidestZone) return {};
    const char* const set = std::getenv("TZ");
    const Message half = duration_message(late[late.size() / 2]);
    if (set == nullptr)
        return Message("{} of {} files are late, half of them by {} or less: check the time zone of this machine",
                       late.size(), files, half);
    return Message("{} of {} files are late, half of them by {} or less: check the time zone {}", late.size(), files,
                   half, set);
}

}  // namespace dynlab::inline course
