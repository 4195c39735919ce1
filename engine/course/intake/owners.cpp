#include "course/intake/owners.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "data_io/text_table.h"
#include "platform/error.h"
#include "platform/text/foreign_text.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kMinInnerLength = 4;  ///< bytes of what is looked for in the middle of a name

bool is_number_word(const std::string& word) {
    return !word.empty() && word.front() >= '0' && word.front() <= '9';
}

std::string joined_words(const Words& words) {
    return fmt::format("{}", fmt::join(words, ""));
}

/// As German and its neighbors write names without their dots and rings: ä is ae, å is aa, ø is oe.
std::string spelt_out(std::string_view text) {
    constexpr std::u32string_view kDotted = U"äöüÄÖÜøØ", kRinged = U"åÅ";
    std::string plain;
    for (const char32_t c : characters_in(composed(text))) {
        const bool dotted = kDotted.find(c) != std::u32string_view::npos;
        const bool ringed = kRinged.find(c) != std::u32string_view::npos;
        plain += dotted ? folded_letter(c) + "e" : ringed ? "aa" : utf8_of(c);
    }
    return plain;
}

bool names_a_group(const std::string& word) {
    static const std::set<std::string> kGroup = {"group", "groups",  "groupe", "gruppe",  "grupo",  "gruppo", "groep",
                                                 "grupp", "grupa",   "team",   "equipe",  "equipo", "grp",    "gr",
                                                 "g",     "skupina", "ryhma",  "csoport", "группа", "команда"};
    return kGroup.contains(word);
}

/// The words with which groups begin, where a number follows, all as one.
Words with_plain_groups(Words words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
        if (names_a_group(words[i]) && is_number_word(words[i + 1])) words[i] = "group";
    return words;
}

/// All rotations of the words, because the family name may come first.
std::vector<Words> rotations_of(Words words) {
    std::vector<Words> all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        all.push_back(words);
        std::rotate(words.begin(), words.begin() + 1, words.end());
    }
    return all;
}

std::vector<std::size_t> without_doubles(std::vector<std::size_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

std::vector<std::size_t> in_both(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
    std::vector<std::size_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
}

const std::string& own_name(const Submission& submission) {
    return submission.person.empty() ? submission.name : submission.person;
}

}  // namespace

std::vector<std::string> name_words(std::string_view given) {
    const std::string whole = composed(given);
    std::string_view text = whole;
    Words words;
    enum class Kind { kNone, kLetters, kDigits } kind = Kind::kNone;
    while (!text.empty()) {
        const char32_t c = next_character(text);
        if (is_ignorable(c)) continue;
        const std::string letter = folded_letter(c);
        if (letter.empty()) {
            kind = Kind::kNone;
            continue;
        }
        const Kind here = is_number_word(letter) ? Kind::kDigits : Kind::kLetters;
        if (here != kind || is_ideograph(c)) words.emplace_back();
        words.back() += letter;
        kind = is_ideograph(c) ? Kind::kNone : here;
    }
    for (std::string& word : words)
        if (is_number_word(word)) word.erase(0, std::min(word.find_first_not_of('0'), word.size() - 1));
    return words;
}

bool same_person(const std::string& a, const std::string& b) {
    Words one = name_words(a), other = name_words(b);
    std::ranges::sort(one), std::ranges::sort(other);
    return !one.empty() && one == other;
}

bool is_word_for_group(const std::string& word) {
    const Words words = name_words(word);
    return words.size() == 1 && names_a_group(words.front());
}

Owners::Owners(const std::vector<Student>& students, const std::vector<std::string>& groups) : students_(students) {
    for (const std::string& group : groups) owner_of_group(group);
    for (std::size_t i = 0; i < students.size(); ++i) {
        const Student& student = students[i];
        std::size_t owner = owners_.size();
        if (student.group.empty())
            owners_.push_back({student.name.empty() ? student.id : student.name, {}, false});
        else
            owner = owner_of_group(student.group);
        owners_[owner].students.push_back(i);
        owner_of_.push_back(owner);
        add_person(student, i);
    }
}

std::size_t Owners::owner_of_group(const std::string& name) {
    const auto [place, fresh] = group_names_.emplace(name, owners_.size());
    if (!fresh) return place->second;
    owners_.push_back({name, {}, true});
    Words words = with_plain_groups(name_words(name));
    if (words.empty()) return place->second;
    group_words_.emplace(words, place->second);
    if (words.size() == 1 && is_number_word(words.front()))
        group_words_.emplace(Words{"group", words.front()}, place->second);
    longest_ = std::max(longest_, words.size() + 1);
    return place->second;
}

void Owners::add_person(const Student& student, std::size_t index) {
    std::set<std::string> joined;
    std::set<Words> in_words;
    const auto add_name = [&](const std::string& name) {
        for (const std::string& spelling : {name, spelt_out(name)})
            for (const Words& words : rotations_of(name_words(spelling))) {
                joined.insert(joined_words(words));
                if (words.size() > 1) in_words.insert(words);
            }
    };
    add_name(student.name);
    for (const FormerName& former : student.former) add_name(former.name);
    for (const std::string& text : {student.id, student.mail}) {
        const Words words = name_words(text);
        joined.insert(joined_words(words));
        if (joined_words(words).size() >= kMinInnerLength) in_words.insert(words);
    }
    joined.insert(joined_words(name_words(student.mail.substr(0, student.mail.find('@')))));
    joined.erase("");
    for (const std::string& name : joined) joined_names_.emplace(name, index);
    for (const Words& words : in_words) {
        person_words_.emplace(words, index);
        longest_ = std::max(longest_, words.size());
    }
}

std::vector<std::size_t> Owners::owners_of(const std::vector<std::size_t>& students) const {
    std::vector<std::size_t> owners;
    for (const std::size_t student : students) owners.push_back(owner_of_[student]);
    return without_doubles(owners);
}

void Owners::read_list(const std::filesystem::path& file) {
    const TextTable table = read_text_table(file);
    const auto submission = table.column("submission"), group = table.column("group"), id = table.column("id");
    if (!submission || (!group && !id))
        throw EnvironmentError(
            "{}: the columns \"submission\" and \"group\", or \"submission\" and \"id\", are required; the columns are "
            "{}",
            file.string(), base::listed(table.names));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        const auto fail = [&](const Message& what) {
            throw EnvironmentError("{}, line {}: {}", file.string(), table.lines[i], what);
        };
        const std::string named_group = group ? row[*group] : "", named_id = id ? row[*id] : "";
        std::optional<std::size_t> owner = named_group.empty() ? std::nullopt : group_called(named_group);
        for (std::size_t k = 0; k < students_.size() && !owner; ++k)
            if (!named_id.empty() && students_[k].id == named_id) owner = owner_of_[k];
        if (!owner)
            fail(named_id.empty() ? Message("unknown group \"{}\"; use a group of the roster", named_group)
                                  : Message("no student has the id \"{}\"; use an id of the roster", named_id));
        const std::string key = archive_stem(composed(row[*submission])).value_or(composed(row[*submission]));
        if (!list_.emplace(key, *owner).second)
            fail(Message("\"{}\" already has an owner in an earlier row; delete one of the two rows", key));
    }
}

std::optional<std::size_t> Owners::listed(const Submission& submission) const {
    const std::string file = composed(submission.path.filename().string());
    for (const std::string& key : {submission.name, file, archive_stem(file).value_or(file), submission.lms_id})
        if (const auto found = list_.find(key); !key.empty() && found != list_.end()) return found->second;
    return {};
}

std::vector<std::string> Owners::unmatched_names(const std::vector<Submission>& submissions) const {
    std::vector<std::string> unused;
    for (const auto& [key, owner] : list_) {
        const bool used = std::any_of(submissions.begin(), submissions.end(), [&, &key = key](const Submission& s) {
            const std::string file = composed(s.path.filename().string());
            return s.name == key || s.lms_id == key || archive_stem(file).value_or(file) == key;
        });
        if (!used) unused.push_back(key);
    }
    return unused;
}

std::optional<std::size_t> Owners::group_called(const std::string& name) const {
    if (const auto found = group_names_.find(name); found != group_names_.end()) return found->second;
    const auto [first, last] = group_words_.equal_range(with_plain_groups(name_words(name)));
    if (first == last || std::next(first) != last) return {};
    return first->second;
}

std::vector<std::size_t> Owners::students_called(const std::string& name) const {
    std::vector<std::size_t> students, exactly;
    for (const std::string& spelling : {name, spelt_out(name)}) {
        const auto [first, last] = joined_names_.equal_range(joined_words(name_words(spelling)));
        for (auto person = first; person != last; ++person) students.push_back(person->second);
    }
    students = without_doubles(students);
    if (students.size() < 2) return students;
    // Two whose names differ by an accent only.
    for (const std::size_t student : students)
        if (students_[student].name == name || students_[student].id == name) exactly.push_back(student);
    return exactly.empty() ? students : exactly;
}

/// Names and numbers at any position among the words, without those inside a longer match.
std::vector<Owners::Evidence> Owners::evidence_in(const Words& words) const {
    std::vector<Evidence> all;
    for (std::size_t begin = 0; begin < words.size(); ++begin)
        for (std::size_t end = begin + 1; end <= std::min(words.size(), begin + longest_); ++end) {
            const Words part(words.begin() + static_cast<std::ptrdiff_t>(begin),
                             words.begin() + static_cast<std::ptrdiff_t>(end));
            const auto [first, last] = person_words_.equal_range(part);
            for (auto person = first; person != last; ++person)
                all.push_back({begin, end, owner_of_[person->second], person->second, false});
            const bool may_match_group = begin == 0 || (joined_words(part).size() >= kMinInnerLength &&
                                                        !(part.size() == 1 && is_number_word(part.front())));
            const auto [one, beyond] = group_words_.equal_range(part);
            for (auto group = one; may_match_group && group != beyond; ++group)
                all.push_back({begin, end, group->second, 0, true});
        }
    std::erase_if(all, [longer = all](const Evidence& e) {
        return std::any_of(longer.begin(), longer.end(), [&](const Evidence& other) {
            return other.begin <= e.begin && e.end <= other.end && other.end - other.begin > e.end - e.begin;
        });
    });
    // The group at the beginning is meant, not one that is named after it.
    const bool begins = std::any_of(all.begin(), all.end(), [](const Evidence& e) { return e.group && e.begin == 0; });
    if (begins) std::erase_if(all, [](const Evidence& e) { return e.group && e.begin > 0; });
    return all;
}

/// Those who are called so and no more; `students` are the persons among them.
std::vector<std::size_t> Owners::whole(const std::string& name, std::vector<std::size_t>& students) const {
    if (const auto found = group_names_.find(name); found != group_names_.end()) return {found->second};
    students = students_called(name);
    if (!students.empty()) return owners_of(students);
    if (const auto group = group_called(name)) return {*group};
    return {};
}

Owners::Found Owners::found(const std::vector<std::size_t>& owners, bool by_prefix) const {
    Found result;
    if (owners.empty()) {
        result.error_reason = Message("the name matches no group and no student");
        return result;
    }
    if (owners.size() > 1) {
        std::vector<std::string> names;
        for (const std::size_t owner : owners) names.push_back(owners_[owner].name);
        result.error_reason = Message("the name matches several groups or students: {}", base::listed(names));
        result.doubtful = true;
        return result;
    }
    const Owner& owner = owners_[owners.front()];
    result.students = owner.students;
    if (owner.group) result.group = owner.name;
    result.by_prefix = by_prefix;
    return result;
}

/// The owner of a submission whose senders a platform lists. Without groups, the listed students own it together.
Owners::Found Owners::by_list(const std::vector<Submitter>& submitters) const {
    std::vector<std::size_t> students;
    for (const Submitter& submitter : submitters)
        for (const std::string& text : {submitter.id, submitter.mail, submitter.name}) {
            const std::vector<std::size_t> called = text.empty() ? std::vector<std::size_t>{} : students_called(text);
            if (called.size() != 1) continue;
            students.push_back(called.front());
            break;
        }
    students = without_doubles(students);
    const std::vector<std::size_t> owners = owners_of(students);
    const bool single = std::none_of(owners.begin(), owners.end(), [this](std::size_t o) { return owners_[o].group; });
    if (owners.size() < 2 || !single) return found(owners);
    Found together;
    together.students = students;
    together.by_prefix = true;
    return together;
}

Owners::Found Owners::find(const Submission& submission) const {
    const Found written = as_written(submission);
    if (written.anybody() || written.doubtful) return written;
    std::vector<Found> others;
    for (const std::string& reading : other_readings_of_name(own_name(submission))) {
        Submission read;
        read.name = reading;
        Found other = as_written(read);
        const bool fresh = std::none_of(others.begin(), others.end(), [&](const Found& before) {
            return before.students == other.students && before.group == other.group;
        });
        if (other.anybody() && other.by_prefix && fresh) others.push_back(std::move(other));
    }
    return others.size() == 1 ? others.front() : written;
}

Owners::Found Owners::called(const std::string& name) const {
    std::vector<std::size_t> students, owners = whole(name, students);
    const Words requested = name_words(name);
    for (std::size_t i = 0; i < students_.size() && owners.empty(); ++i)
        if (!name.empty() && (students_[i].moodle == name || students_[i].canvas == name))
            owners.push_back(owner_of_[i]);
    const bool unmatched = owners.empty() && !requested.empty();
    for (std::size_t i = 0; i < students_.size() && unmatched; ++i) {
        const Words parts = name_words(students_[i].name);
        const auto bears = [&parts](const std::string& word) { return std::ranges::find(parts, word) != parts.end(); };
        if (std::ranges::all_of(requested, bears)) owners.push_back(owner_of_[i]);
    }
    return found(without_doubles(owners));
}

Owners::Found Owners::as_written(const Submission& submission) const {
    if (const auto owner = listed(submission)) return found({*owner});
    if (!submission.submitters.empty()) return by_list(submission.submitters);
    std::vector<std::size_t> by_platform, by_id;
    for (std::size_t i = 0; i < students_.size() && !submission.lms_id.empty(); ++i) {
        const Student& s = students_[i];
        if (s.moodle == submission.lms_id || s.canvas == submission.lms_id) by_platform.push_back(i);
        if (s.id == submission.lms_id) by_id.push_back(i);
    }
    const std::string& own = own_name(submission);
    std::vector<std::size_t> students, owners = whole(own, students);
    bool by_prefix = !owners.empty();
    if (owners.empty()) {
        for (const Evidence& e : evidence_in(with_plain_groups(name_words(own)))) {
            owners.push_back(e.owner);
            by_prefix = by_prefix || e.begin == 0;
        }
        owners = without_doubles(owners);
    }
    // The platform's number distinguishes two students with the same name. If name and number contradict each other,
    // the submission stays unmatched.
    if (!by_platform.empty()) {
        const std::vector<std::size_t> numbered = owners_of(by_platform);
        if (owners.empty()) return found(numbered);
        const std::vector<std::size_t> both = in_both(owners, numbered);
        if (!both.empty()) return found(both);
        Found contradiction;
        contradiction.doubtful = true;
        contradiction.error_reason =
            Message("the number {} in the name belongs to {}, but the name matches {}", submission.lms_id,
                    owners_[numbered.front()].name, owners_[owners.front()].name);
        return contradiction;
    }
    if (owners.empty()) return found(owners_of(by_id));
    if (owners.size() > 1 && !by_id.empty())
        if (const auto both = in_both(owners, owners_of(by_id)); !both.empty()) return found(both);
    return found(owners, by_prefix);
}

std::vector<std::string> Owners::names() const {
    std::vector<std::string> all;
    for (const auto& [name, owner] : group_names_) all.push_back(name);
    for (const Student& student : students_) all.push_back(student.name), all.push_back(student.id);
    return all;
}

}  // namespace dynlab::inline course
