#include "course/anonymity/name_patterns.h"

#include <algorithm>

#include "documents/text_lines.h"
#include "platform/text/ordinary_words.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMinNameLength = 4;                             ///< letters of a surname or given name alone
constexpr std::size_t kMinGivenNameLength = 3;                        ///< of the document's own authors
constexpr std::size_t kMinNumberDigits = 6;                           ///< digits
constexpr std::size_t kMinMixedLength = 5;                            ///< letters and digits
constexpr std::size_t kMinSearchedDigits = 3;                         ///< of a number that is searched for
constexpr std::size_t kMinOrdinaryLength = 3, kMinAccountLength = 6;  ///< letters

/// A word of a name: "O'Brien" has two tokens.
struct Part {
    std::string letters;
    std::vector<std::size_t> breaks;
    bool capitals = false;  ///< written in capitals throughout
};

struct FullName {
    std::vector<Part> given;
    Part surname;
};

Part part_of(const std::string& word) {
    Part part;
    for (const NameToken& token : name_tokens(word)) {
        if (!part.letters.empty()) part.breaks.push_back(part.letters.size());
        part.letters += token.letters;
    }
    std::size_t large = 0, letters = 0;
    for (std::string_view rest = word; !rest.empty();) {
        const char32_t c = next_character(rest);
        large += is_capital(c);
        letters += !folded_letter(c).empty();
    }
    part.capitals = letters > 1 && large == letters;
    return part;
}

std::vector<Part> parts_of(const std::string& text) {
    std::vector<Part> parts;
    std::string word;
    for (const char c : text + " ") {
        if (c != ' ' && c != '\t') {
            word += c;
            continue;
        }
        Part part = part_of(word);
        if (!part.letters.empty()) parts.push_back(std::move(part));
        word.clear();
    }
    return parts;
}

/// The surname is the part before a comma, the part in capitals, or the last part.
FullName full_name(const std::string& name) {
    FullName result;
    const auto comma = name.find(',');
    if (comma != std::string::npos) {
        std::vector<Part> surname = parts_of(name.substr(0, comma));
        result.given = parts_of(name.substr(comma + 1));
        for (const Part& part : surname) {
            if (!result.surname.letters.empty()) result.surname.breaks.push_back(result.surname.letters.size());
            for (const std::size_t at : part.breaks)
                result.surname.breaks.push_back(at + result.surname.letters.size());
            result.surname.letters += part.letters;
        }
        return result;
    }
    std::vector<Part> parts = parts_of(name);
    if (parts.empty()) return result;
    const auto is_large = [](const Part& part) { return part.capitals; };
    auto surname = parts.end() - 1;
    if (std::ranges::count_if(parts, is_large) == 1) surname = std::ranges::find_if(parts, is_large);
    result.surname = *surname;
    parts.erase(surname);
    result.given = std::move(parts);
    return result;
}

void append(NamePattern& pattern, const Part& part) {
    if (!pattern.letters.empty()) pattern.breaks.insert(pattern.letters.size());
    for (const std::size_t at : part.breaks) pattern.breaks.insert(at + pattern.letters.size());
    pattern.letters += part.letters;
}

NamePattern whole_name(const std::string& who, const std::vector<Part>& parts, bool reversed = false) {
    NamePattern pattern;
    pattern.reversed = reversed;
    pattern.who = who;
    pattern.capital = true;
    for (const Part& part : parts) {
        append(pattern, part);
        pattern.capital = pattern.capital && (part.letters.size() < kMinNameLength || is_ordinary_word(part.letters));
    }
    return pattern;
}

bool may_occur_alone(const Part& part) {
    return part.letters.size() >= kMinNameLength && !is_ordinary_word(part.letters);
}

/// The parts of a double name, "Mueller-Luedenscheid", that can replace the full name.
std::vector<Part> halves_of(const Part& surname) {
    std::vector<Part> halves;
    std::size_t begin = 0;
    for (std::size_t k = 0; k <= surname.breaks.size() && !surname.breaks.empty(); ++k) {
        const std::size_t end = k < surname.breaks.size() ? surname.breaks[k] : surname.letters.size();
        Part half;
        half.letters = surname.letters.substr(begin, end - begin);
        if (half.letters.size() >= kMinNameLength) halves.push_back(std::move(half));
        begin = end;
    }
    return halves;
}

Part initial_of(const Part& part) {
    Part initial;
    initial.letters = part.letters.substr(0, 1);
    return initial;
}

/// Names that are too short or too common to match alone are matched with an initial: those of the document's authors.
void add_initialled(const std::string& who, const FullName& name, std::vector<NamePattern>& patterns) {
    const auto add = [&](const Part& first, const Part& second, bool reversed) {
        NamePattern pattern = whole_name(who, {first, second}, reversed);
        pattern.whole = false;
        pattern.capital = pattern.initialled = true;
        for (const Part& part : name.given) pattern.initials += part.letters.front();
        patterns.push_back(std::move(pattern));
    };
    for (const Part& given : name.given) {
        if (given.letters.size() > 1) add(given, initial_of(name.surname), false);
        if (may_occur_alone(name.surname)) continue;
        add(initial_of(given), name.surname, false);
        add(name.surname, initial_of(given), true);
    }
}

void add_names(const std::string& who, const FullName& name, bool own, std::vector<NamePattern>& patterns) {
    const std::size_t first = patterns.size();
    if (!name.given.empty() && !name.surname.letters.empty()) {
        std::vector<Part> forward = name.given, backward = {name.surname};
        forward.push_back(name.surname);
        backward.insert(backward.end(), name.given.begin(), name.given.end());
        patterns.push_back(whole_name(who, forward));
        patterns.push_back(whole_name(who, backward, true));
        if (name.given.size() > 1) {
            patterns.push_back(whole_name(who, {name.given.front(), name.surname}));
            patterns.push_back(whole_name(who, {name.surname, name.given.front()}, true));
        }
        for (const Part& half : halves_of(name.surname)) {
            patterns.push_back(whole_name(who, {name.given.front(), half}));
            patterns.push_back(whole_name(who, {half, name.given.front()}, true));
        }
    }
    NamePattern alone;
    alone.who = who;
    alone.whole = false;
    alone.capital = true;
    for (const Part& part : name.given) alone.initials += part.letters.front();
    if (may_occur_alone(name.surname)) {
        append(alone, name.surname);
        patterns.push_back(alone);
    } else if (name.surname.letters.size() >= kMinOrdinaryLength && is_ordinary_word(name.surname.letters)) {
        append(alone, name.surname);
        alone.ordinary = true;
        patterns.push_back(alone);
        alone.ordinary = false;
    }
    if (!own) return;
    if (!name.given.empty() && !name.surname.letters.empty()) add_initialled(who, name, patterns);
    for (const Part& part : name.given) {
        if (part.letters.size() < kMinGivenNameLength || is_ordinary_word(part.letters)) continue;
        NamePattern given = alone;
        given.letters.clear();
        given.breaks.clear();
        given.initials.clear();
        given.given_only = true;
        append(given, part);
        patterns.push_back(given);
    }
    for (std::size_t i = first; i < patterns.size(); ++i) patterns[i].own = true;
}

/// "Müller" may be written "Mueller".
std::string umlauts_written_out(std::string name) {
    constexpr std::pair<const char*, const char*> kWritten[] = {{"ä", "ae"}, {"Ä", "Ae"}, {"ö", "oe"}, {"Ö", "Oe"},
                                                                {"ø", "oe"}, {"Ø", "Oe"}, {"ü", "ue"}, {"Ü", "Ue"},
                                                                {"å", "aa"}, {"Å", "Aa"}};
    for (const auto& [letter, written] : kWritten) name = replaced(name, letter, written);
    return name;
}

/// A number, an account's name, a group's name with a number in it.
void add_number(NameKind kind, const std::string& who, const std::string& text, std::vector<NamePattern>& patterns) {
    NamePattern pattern;
    pattern.kind = kind;
    pattern.who = who;
    bool digits = false, letters = false;
    for (const NameToken& token : name_tokens(text)) {
        if (!pattern.letters.empty()) pattern.breaks.insert(pattern.letters.size());
        pattern.letters += token.letters;
        (token.digits ? digits : letters) = true;
        if (token.digits && token.letters.size() == 1) pattern.spaced = false;
    }
    if (!digits || (kind != NameKind::kGroup && !is_searched_number(text))) return;
    pattern.labeled = pattern.letters.size() < (letters ? kMinMixedLength : kMinNumberDigits);
    patterns.push_back(pattern);
}

/// Of one digit, written and Roman.
constexpr const char* kWrittenNumbers[][2] = {{"zero", "0"},     {"one", "i"},  {"two", "ii"}, {"three", "iii"},
                                              {"four", "iv"},    {"five", "v"}, {"six", "vi"}, {"seven", "vii"},
                                              {"eight", "viii"}, {"nine", "ix"}};

/// "Les Loups": a name without a number. One word counts only for the authors, and not if it is an ordinary word.
void add_team(const std::string& group, const std::vector<NameToken>& tokens, bool own,
              std::vector<NamePattern>& patterns) {
    NamePattern pattern;
    pattern.kind = NameKind::kGroup;
    pattern.who = group;
    for (const NameToken& token : tokens) {
        if (!pattern.letters.empty()) pattern.breaks.insert(pattern.letters.size());
        pattern.letters += token.letters;
    }
    constexpr std::size_t kMinLetters = 5;
    if (pattern.letters.size() < kMinLetters) return;
    if (tokens.size() == 1 && (!own || is_ordinary_word(pattern.letters))) return;
    patterns.push_back(std::move(pattern));
}

/// "group-01" is also "Team 01", "group1" or "Group 1", in all words for a group; of the authors' own, "G01" too.
void add_group(const std::string& group, bool own, std::vector<NamePattern>& patterns) {
    const std::size_t first = patterns.size();
    add_number(NameKind::kGroup, group, group, patterns);
    const std::vector<NameToken> tokens = name_tokens(group);
    if (std::ranges::none_of(tokens, &NameToken::digits)) add_team(group, tokens, own, patterns);
    if (tokens.size() == 2 && !tokens[0].digits && tokens[1].digits) {
        std::vector<std::string> words = {"group", "groupe", "gruppe", "grp", "team", "equipe"};
        const std::string& given = tokens[1].letters;
        const std::string number = given.substr(std::min(given.find_first_not_of('0'), given.size() - 1));
        if (std::ranges::find(words, tokens[0].letters) == words.end())
            words = {tokens[0].letters};
        else if (own)
            words.push_back("gr");
        const auto add = [&](const std::string& word, const std::string& digits) {
            NamePattern pattern;
            pattern.kind = NameKind::kGroup;
            pattern.who = group;
            pattern.letters = word + digits;
            pattern.breaks = {word.size()};
            pattern.bare = digits.front() != '0';
            patterns.push_back(std::move(pattern));
        };
        for (const std::string& word : words) {
            add(word, number);
            add(word, number.size() == 1 ? "0" + number : given);
            if (own && number.size() == 1)
                for (const char* written : kWrittenNumbers[static_cast<std::size_t>(number.front() - '0')])
                    add(word, written), patterns.back().bare = true;
        }
        if (own && given.front() == '0') add("g", given), patterns.back().breaks.clear();
    }
    for (std::size_t i = first; i < patterns.size(); ++i) patterns[i].own = own;
}

}  // namespace

bool is_searched_number(const std::string& id) {
    std::size_t letters = 0;
    for (const NameToken& token : name_tokens(id)) letters += token.letters.size();
    return letters >= kMinSearchedDigits;
}

Message numbers_too_short(const std::vector<Student>& students) {
    const auto is_short = [](const Student& student) { return !is_searched_number(student.id); };
    const auto first = std::ranges::find_if(students, is_short);
    if (first == students.end()) return {};
    return plural(std::ranges::count_if(students, is_short),
                  "{} id with fewer than {} letters and digits is not searched for in documents: {}",
                  "{} ids with fewer than {} letters and digits are not searched for in documents; an example is {}",
                  kMinSearchedDigits, first->id);
}

CitedAuthor cited_author(const std::string& name) {
    const FullName full = full_name(name);
    CitedAuthor author{full.surname.letters, {}};
    for (const Part& part : full.given) author.given.push_back(part.letters);
    return author;
}

std::vector<NamePattern> patterns_of_pair(const Student& one, const Student& other) {
    const FullName a = full_name(one.name), b = full_name(other.name);
    std::vector<NamePattern> patterns;
    const auto add = [&](const Part& first, const Part& second) {
        if (first.letters.empty() || second.letters.empty()) return;
        NamePattern pattern = whole_name(one.name, {first, second});
        pattern.whole = false;
        pattern.capital = pattern.connected = pattern.own = true;
        patterns.push_back(std::move(pattern));
    };
    add(a.surname, b.surname);
    add(b.surname, a.surname);
    if (a.given.empty() || b.given.empty()) return patterns;
    add(a.given.front(), b.given.front());
    add(b.given.front(), a.given.front());
    return patterns;
}

std::vector<NamePattern> patterns_of(const Student& student, bool own) {
    const std::string& who = student.name.empty() ? student.id : student.name;
    std::vector<NamePattern> patterns;
    add_names(who, full_name(student.name), own, patterns);
    const std::string written_out = umlauts_written_out(student.name);
    if (written_out != student.name) add_names(who, full_name(written_out), own, patterns);
    add_number(NameKind::kNumber, who, student.id, patterns);
    if (!student.group.empty() && student.group != student.id) add_group(student.group, own, patterns);
    for (const std::string& group : student.other_groups) add_group(group, own, patterns);
    const std::string account = student.mail.substr(0, student.mail.find('@'));
    if (account != student.id) add_number(NameKind::kMail, who, account, patterns);
    Part letters = part_of(account);
    if (letters.letters.size() >= kMinNumberDigits && !is_ordinary_word(letters.letters)) {
        NamePattern pattern = whole_name(who, {letters});
        pattern.kind = NameKind::kMail;
        pattern.capital = false;
        patterns.push_back(pattern);
    }
    if (const FullName name = full_name(student.name); !name.given.empty()) {
        NamePattern pattern;
        pattern.kind = NameKind::kMail;
        pattern.who = who;
        pattern.account = true;
        pattern.own = own;
        const std::string &given = name.given.front().letters, &surname = name.surname.letters;
        const auto add = [&](const std::string& account_name, std::size_t min_length) {
            if (account_name.size() < min_length) return;
            pattern.letters = account_name;
            patterns.push_back(pattern);
        };
        if (may_occur_alone(name.surname)) {
            add(given.substr(0, 1) + surname, kMinAccountLength);
            if (const std::string turned = surname + given.substr(0, 1); !is_ordinary_word(turned))
                add(turned, kMinAccountLength);
        }
        if (const std::string short_name = given + surname.substr(0, 1); own && !is_ordinary_word(short_name))
            add(short_name, kMinNameLength);
    }
    std::erase_if(patterns, [](const NamePattern& pattern) { return pattern.letters.empty(); });
    return patterns;
}

}  // namespace dynlab::inline course
