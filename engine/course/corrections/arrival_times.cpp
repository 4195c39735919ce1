#include "course/corrections/arrival_times.h"

#include <chrono>

#include "base/error.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

constexpr Instant kYear2000 = 946684800;

/// "Participant 900010" is the number in the names of Moodle's folders.
std::string without_word(const std::string& identifier) {
    const std::string word = "participant ";
    return in_small_letters(identifier).starts_with(word) ? identifier.substr(word.size()) : identifier;
}

/// Also as Moodle writes times in English: "Friday, 27 February 2026, 5:30 PM".
Instant time_in(const std::string& text, const CourseClock& clock) {
    const auto read = clock_reading(text, {"%A, %d %B %Y, %I:%M %p", "%d %B %Y, %I:%M %p", "%A, %d %B %Y, %H:%M"});
    if (read && !read->exists) throw InvalidArgument("the time \"{}\" does not exist in {}", text, clock.zone());
    if (read) return read->instant;
    return clock.parse(text, "the time");
}

}  // namespace

ArrivalTimes::ArrivalTimes(const std::filesystem::path& csv, const CourseClock& clock) {
    const TextTable table = read_text_table(csv);
    const auto first_of = [&table](std::initializer_list<const char*> names) {
        std::vector<std::size_t> columns;
        for (const char* name : names)
            if (const auto column = table.column(name)) columns.push_back(*column);
        return columns;
    };
    const auto whose =
        first_of({"identifier", "id", "id number", "group", "name", "full name", "mail", "email", "email address"});
    const auto when = first_of({"last modified (submission)", "time", "received", "submitted_at"});
    if (whose.empty() || when.empty())
        throw EnvironmentError(
            "{}: wanted are a column identifier, id, group, name or mail, and one \"last modified (submission)\", time "
            "or received; there are {}",
            csv.string(), listed(table.names));
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const std::string& text = table.rows[r][when.front()];
        if (text.empty() || text == "-") continue;
        try {
            const Instant time = time_in(text, clock);
            for (const std::size_t column : whose)
                if (const std::string& key = table.rows[r][column]; !key.empty())
                    times_[in_small_letters(without_word(key))] = time;
        } catch (const InvalidArgument& error) {
            throw EnvironmentError("{}, line {}: {}", csv.string(), table.lines[r], message_of(error));
        }
    }
}

std::optional<Instant> ArrivalTimes::of(const IncomingFile& file) const {
    for (const std::string& key : {file.sender.lms_id, file.sender.person, file.sender.name})
        if (const auto found = times_.find(in_small_letters(key)); !key.empty() && found != times_.end())
            return found->second;
    return {};
}

std::optional<Instant> time_in_archive(const IncomingFile& file) {
    const auto written = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(file.file));
    const Instant time = std::chrono::duration_cast<std::chrono::seconds>(written.time_since_epoch()).count();
    if (time < kYear2000) return {};
    return time;
}

}  // namespace dynlab::inline course
