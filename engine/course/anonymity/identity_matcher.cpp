#include "course/anonymity/identity_matcher.h"

#include <re2/re2.h>
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "platform/atomic_file.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMinAddressLength = 6;
constexpr int kMaxDecodings = 2;                ///< of percent-encoded text
constexpr std::size_t kMinLowercaseLength = 6;  ///< letters of a surname

using Tokens = std::vector<NameToken>;

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::any_of(words, [&word](const char* one) { return word == one; });
}

/// 20214711.5 is not a student's number.
bool has_decimals(const Tokens& tokens, std::size_t end, std::string_view text) {
    const std::size_t point = tokens[end - 1].end;
    return end < tokens.size() && tokens[end].digits && text[point] == '.' && tokens[end].begin == point + 1;
}

/// "May, Park's method", "mark, young": a name of ordinary words, neither written as names are nor joined to one word.
bool may_be_words(const NamePattern& pattern, const Tokens& tokens, std::size_t first, std::size_t end,
                  std::string_view written) {
    if (!pattern.whole || !pattern.capital) return false;
    const bool comma = written.find(',') != std::string_view::npos;
    if (comma && !pattern.reversed) return true;
    const bool capitals = std::all_of(tokens.begin() + static_cast<std::ptrdiff_t>(first),
                                      tokens.begin() + static_cast<std::ptrdiff_t>(end),
                                      [](const NameToken& token) { return token.capital || token.digits; });
    return !capitals && written.find_first_of(" ,\n") != std::string_view::npos;
}

bool is_year(const NameToken& token) {
    return token.digits && token.letters.size() == 4 &&
           (token.letters.starts_with("19") || token.letters.starts_with("20"));
}

/// A surname alone that a citation gives: "Lovelace et al.", "Lovelace (2008)", "P. Lovelace", "Lovelace, P.".
bool looks_cited(const NamePattern& pattern, const Tokens& tokens, std::size_t first, std::size_t end,
                 std::string_view text) {
    const auto is_foreign_initial = [&](const NameToken& token) {
        return token.letters.size() == 1 && !token.digits && token.capital &&
               pattern.initials.find(token.letters) == std::string::npos;
    };
    const std::string_view before = text.substr(0, tokens[first].begin);
    for (const std::string_view sign : {"\u00A9", "\u00A9 ", "(c)", "(c) ", "(C)", "(C) "})
        if (before.ends_with(sign)) return false;  // the year of what is theirs
    if (end < tokens.size() && tokens[end].gap != Gap::kWide) {
        const NameToken& behind = tokens[end];
        if (behind.letters == "et" && end + 1 < tokens.size() && tokens[end + 1].letters == "al") return true;
        if (is_year(behind) || is_foreign_initial(behind)) return true;
    }
    // "G. M. Hopper": a second initial that the roster does not know.
    bool foreign = false;
    for (std::size_t i = first; i > 0 && tokens[i].gap != Gap::kWide; --i) {
        const NameToken& initial = tokens[i - 1];
        if (initial.letters.size() != 1 || initial.digits || !initial.capital) break;
        if (!is_foreign_initial(initial)) return false;
        foreign = true;
    }
    return foreign;
}

/// Whether what is written is a part of an identifier, a path or an address rather than a word in a sentence.
bool is_in_identifier(std::string_view text, std::size_t begin, std::size_t end) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    if (begin > 0) {
        const char before = text[begin - 1];
        const bool pointed = before == '.' && begin > 1 && is_word(text[begin - 2]);
        if (pointed || std::isdigit(static_cast<unsigned char>(before)) != 0 ||
            std::string_view("_/\\~@").find(before) != std::string_view::npos)
            return true;
    }
    if (end >= text.size()) return false;
    const char behind = text[end];
    const bool pointed = behind == '.' && end + 1 < text.size() && is_word(text[end + 1]);
    return pointed || std::isdigit(static_cast<unsigned char>(behind)) != 0 ||
           std::string_view("_/\\@$").find(behind) != std::string_view::npos;
}

/// Of "B. Li", "Wu, M." or "Ada L.": not "Ada L" or "B Li".
bool has_point(const NamePattern& pattern, std::string_view text, std::size_t begin, std::size_t end) {
    const std::string_view written = text.substr(begin, end + 1 - begin);
    return written.find(pattern.reversed ? ',' : '.') != std::string_view::npos;
}

/// A group's number without its zeros: "Group 1", "group1", "group_1"; "group 1" counts something.
bool is_counted(const NamePattern& pattern, const Tokens& tokens, std::size_t first, std::size_t end) {
    return pattern.bare && end > first + 1 && tokens[end - 1].gap == Gap::kSpace && !tokens[first].capital;
}

/// Lower case, without white space, accents kept.
std::string squeezed(std::string_view text, std::vector<std::size_t>* offsets) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned char c = static_cast<unsigned char>(text[i]);
        if (c <= ' ') continue;
        result += static_cast<char>(c < 0x80 ? std::tolower(c) : c);
        if (offsets) offsets->push_back(i);
    }
    return result;
}

/// The path of a page on the web is not a home folder.
bool is_in_address(std::string_view text, std::size_t at) {
    const std::size_t blank = text.substr(0, at).find_last_of(" \n\t(<\"");
    const std::string_view word = text.substr(blank == std::string_view::npos ? 0 : blank + 1, at - (blank + 1));
    return word.find("http://") != std::string_view::npos || word.find("https://") != std::string_view::npos;
}

/// Accounts that are not a person's, and names in instructions.
bool is_of_no_person(const std::string& user) {
    return user.size() < 2 ||
           is_one_of(user, {"user", "users", "username", "name", "you", "your", "me", "student", "students", "shared",
                            "public", "default", "guest", "runner", "home", "root"});
}

/// An ordinary word that may be a name: with a capital within a sentence, and no number behind it ("Page 3").
bool may_be_name(const Tokens& tokens, std::size_t at, std::string_view text) {
    const bool counted = at + 1 < tokens.size() && tokens[at + 1].digits && tokens[at + 1].gap == Gap::kSpace;
    const std::size_t from = at > 0 ? tokens[at - 1].end : 0;
    const std::string_view between = text.substr(from, tokens[at].begin - from);
    return tokens[at].capital && !counted && between.find_first_of(".!?:") == std::string_view::npos;
}

/// "%C3%A9" -> "é"; bytes that are not UTF-8 are taken as Latin-1.
std::string percent_decoded(std::string_view text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto digit = [&](std::size_t at) {
            const char c = at < text.size() ? text[at] : ' ';
            return std::isxdigit(static_cast<unsigned char>(c)) != 0 ? std::stoi(std::string(1, c), nullptr, 16) : -1;
        };
        const bool coded = text[i] == '%' && digit(i + 1) >= 0 && digit(i + 2) >= 0;
        bytes += coded ? static_cast<char>(digit(i + 1) * 16 + digit(i + 2)) : text[i];
        if (coded) i += 2;
    }
    std::string utf8;
    for (std::string_view rest = bytes; !rest.empty();) {
        const char first = rest.front();
        utf8 += utf8_of(take_character(rest).value_or(static_cast<unsigned char>(first)));
    }
    return utf8;
}

/// A number that may count or measure something: "N = 123456", "with 123456 samples". Not behind "student" or "ID", in
/// brackets, beside a name or alone in its line.
bool may_count(const Tokens& tokens, std::size_t first, std::size_t end, std::string_view text) {
    const auto is_number = [](const NameToken& token) { return token.digits; };
    const bool digits = std::all_of(tokens.begin() + static_cast<std::ptrdiff_t>(first),
                                    tokens.begin() + static_cast<std::ptrdiff_t>(end), is_number);
    const std::size_t from = first > 0 ? tokens[first - 1].end : 0;
    const std::string_view before = text.substr(from, tokens[first].begin - from);
    if (!digits || is_labeled(tokens, first) || before.find('(') != std::string_view::npos) return false;
    if (first > 0 && before.empty()) return false;  // "s20214711", an account
    if (before.find_first_of("=<>") != std::string_view::npos) return true;
    // Whether the word is one of a sentence, and a space alone is between `behind` and the token before it.
    const auto is_beside = [&](const NameToken& word, std::size_t behind) {
        const std::size_t begin = tokens[behind - 1].end;
        const std::string_view between = text.substr(begin, tokens[behind].begin - begin);
        return !word.digits && !word.capital && tokens[behind].gap == Gap::kSpace &&
               between.find('\n') == std::string_view::npos;
    };
    return (first > 0 && is_beside(tokens[first - 1], first)) || (end < tokens.size() && is_beside(tokens[end], end));
}

NameHit hit_of(std::string_view text, const std::string& who, NameKind kind, std::size_t begin, std::size_t end) {
    return {who, kind, true, false, std::string(text.substr(begin, end - begin)), begin, end};
}

}  // namespace

IdentityMatcher::IdentityMatcher(const std::vector<Student>& students) {
    for (const Student& student : students) add(student);
}

void IdentityMatcher::add_cited(const std::vector<CitedAuthor>& authors) {
    for (const CitedAuthor& author : authors) {
        std::set<std::string>& given = cited_[author.surname];
        std::string joined;
        for (const std::string& name : author.given) {
            given.insert(name);
            given.insert(name.substr(0, 1));
            joined += name;
        }
        cited_names_.insert(joined + author.surname);
        cited_names_.insert(author.surname + joined);
    }
}

/// A cited author's surname beside a given name or initial of theirs, or beside another cited author's surname.
bool IdentityMatcher::is_cited(const NamePattern& pattern, const Tokens& tokens, std::size_t first,
                               std::size_t end) const {
    const auto author = cited_.find(pattern.letters);
    if (pattern.whole || author == cited_.end()) return false;
    const auto belongs = [&](const NameToken& token) {
        const bool own_initial = token.letters.size() == 1 && pattern.initials.find(token.letters) != std::string::npos;
        return !own_initial && (author->second.contains(token.letters) || cited_.contains(token.letters));
    };
    const auto is_connection = [](const NameToken& token) { return is_one_of(token.letters, {"and", "et"}); };
    if (first > 0 && tokens[first].gap != Gap::kWide) {
        const bool skip = first > 1 && is_connection(tokens[first - 1]);
        if (belongs(tokens[first - (skip ? 2 : 1)])) return true;
    }
    if (end == tokens.size() || tokens[end].gap == Gap::kWide) return false;
    const bool skip = end + 1 < tokens.size() && is_connection(tokens[end]);
    return belongs(tokens[end + (skip ? 1 : 0)]);
}

void IdentityMatcher::add(const Student& student, bool own) {
    ++people_;
    add_writings(student, own);
    if (own) {
        for (const Student& other : authors_)
            for (NamePattern& pattern : patterns_of_pair(student, other)) index(std::move(pattern));
        authors_.push_back(student);
    }
    for (const FormerName& former : student.former) {
        Student before = student;
        if (!former.name.empty()) before.name = former.name;
        before.mail = former.mail;
        add_writings(before, own);
    }
}

void IdentityMatcher::add_writings(const Student& student, bool own) {
    for (NamePattern& pattern : patterns_of(student, own)) index(std::move(pattern));
    const std::string address = squeezed(student.mail, nullptr);
    if (address.find('@') != std::string::npos && address.size() >= kMinAddressLength)
        addresses_.emplace_back(address, student.name.empty() ? student.id : student.name);
}

void IdentityMatcher::add_account(const fs::path& home) {
    const std::string folder = home.lexically_normal().string();
    if (std::ranges::count(folder, '/') >= 2 && !is_of_no_person(home.filename().string())) homes_.push_back(folder);
}

void IdentityMatcher::index(NamePattern pattern) {
    std::vector<NamePattern>& row = patterns_[static_cast<unsigned char>(pattern.letters.front())];
    const auto same = [&pattern](const NamePattern& other) {
        return other.who == pattern.who && other.letters == pattern.letters && other.kind == pattern.kind &&
               other.own == pattern.own && other.whole == pattern.whole && other.connected == pattern.connected &&
               other.bare == pattern.bare;
    };
    if (std::ranges::none_of(row, same)) row.push_back(std::move(pattern));
}

void IdentityMatcher::find_patterns(const Tokens& tokens, std::string_view text, TextManner manner,
                                    std::vector<NameHit>& hits) const {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        for (const NamePattern& pattern : patterns_[static_cast<unsigned char>(tokens[i].letters.front())]) {
            const auto match = match_pattern(pattern, tokens, i, text, manner);
            if (!match) continue;
            const std::size_t end = match->end;
            const bool whole_text = manner == TextManner::kData && i == 0 && end == tokens.size();
            const NameToken& last = tokens[end - 1];
            const std::string_view written = text.substr(tokens[i].begin, last.end - tokens[i].begin);
            const bool identifier = is_in_identifier(text, tokens[i].begin, last.end);
            const bool alone = pattern.kind == NameKind::kName && !pattern.whole;
            const bool in_small = manner == TextManner::kProse && alone && !tokens[i].capital;
            const bool short_or_given = pattern.given_only || pattern.letters.size() < kMinLowercaseLength;
            if (pattern.labeled && !whole_text && !is_labeled(tokens, i)) continue;
            if (pattern.kind == NameKind::kNumber && has_decimals(tokens, end, text)) continue;
            if (!whole_text && may_be_words(pattern, tokens, i, end, written)) continue;
            if (!whole_text && is_counted(pattern, tokens, i, end)) continue;
            if (pattern.account && !whole_text && !identifier) continue;
            if (pattern.initialled && !has_point(pattern, text, tokens[i].begin, last.end)) continue;
            if (in_small && !identifier && short_or_given) continue;
            const bool cited = alone && looks_cited(pattern, tokens, i, end, text);
            const bool passed_over = !pattern.own && !authors_.empty();
            const bool as_name =
                manner == TextManner::kProse ? !identifier && may_be_name(tokens, i, text) : whole_text;
            if (pattern.ordinary && (passed_over || cited || !as_name)) continue;
            if (alone && (is_cited(pattern, tokens, i, end) || (cited && cited_.contains(pattern.letters)))) continue;
            bool certain = pattern.given_only ? identifier && pattern.own : pattern.whole || !cited;
            if (in_small && !identifier && !(pattern.own && is_labeled(tokens, i))) certain = false;
            if (pattern.bare && !pattern.own) certain = false;
            if (manner == TextManner::kProse && pattern.kind == NameKind::kNumber && !identifier &&
                may_count(tokens, i, end, text))
                certain = false;
            if (pattern.ordinary || (match->parted && alone)) certain = false;
            if (pattern.whole && cited_names_.contains(pattern.letters)) certain = false;
            hits.push_back({pattern.who, pattern.kind, certain, pattern.ordinary, std::string(written), tokens[i].begin,
                            last.end});
        }
    }
}

void IdentityMatcher::find_addresses(std::string_view text, std::vector<NameHit>& hits) const {
    if (addresses_.empty() || text.find('@') == std::string_view::npos) return;
    std::vector<std::size_t> offsets;
    const std::string bare = squeezed(text, &offsets);
    for (const auto& [address, who] : addresses_) {
        const std::size_t at = bare.find(address);
        if (at != std::string::npos)
            hits.push_back(hit_of(text, who, NameKind::kMail, offsets[at], offsets[at + address.size() - 1] + 1));
    }
}

void IdentityMatcher::find_paths(std::string_view text, std::vector<NameHit>& hits) const {
    static const re2::RE2 folder(R"re(((?:/home\d?/|/homes/|/[Uu]sers/|\\[Uu]sers\\|\\home\\)([^\s/\\()<>"':;,]+)))re");
    static const re2::RE2 prompt(R"re((([\w.-]+)@[\w.-]+):~)re");  // ada@laptop:~$
    for (const re2::RE2* const place : {&folder, &prompt}) {
        re2::StringPiece rest(text.data(), text.size()), whole, user;
        while (re2::RE2::FindAndConsume(&rest, *place, &whole, &user)) {
            const auto begin = static_cast<std::size_t>(whole.data() - text.data());
            if (is_in_address(text, begin) || is_of_no_person(squeezed({user.data(), user.size()}, nullptr))) continue;
            hits.push_back(hit_of(text, std::string(whole), NameKind::kHome, begin, begin + whole.size()));
        }
    }
    for (const std::string& home : homes_) {
        const std::size_t at = text.find(home);
        if (at != std::string_view::npos) hits.push_back(hit_of(text, home, NameKind::kHome, at, at + home.size()));
    }
}

std::vector<NameHit> IdentityMatcher::find(std::string_view given, TextManner manner) const {
    std::vector<NameHit> hits;
    std::string text(given);
    for (int decodings = 0; decodings <= kMaxDecodings; ++decodings) {
        if (people_ > 0) find_patterns(name_tokens(text), text, manner, hits);
        for (const Reading reading : {Reading::kCamel, Reading::kLookAlike})
            if (people_ > 0 && reads_otherwise(text, reading))
                find_patterns(name_tokens(text, reading), text, manner, hits);
        find_addresses(text, hits);
        find_paths(text, hits);
        std::string decoded = text.find('%') == std::string::npos ? text : percent_decoded(text);
        if (decoded == text) break;
        text = std::move(decoded);
    }
    std::ranges::stable_sort(hits, [](const NameHit& a, const NameHit& b) {
        return std::make_tuple(!a.certain, a.begin, b.end) < std::make_tuple(!b.certain, b.begin, a.end);
    });
    std::vector<NameHit> first;
    for (const NameHit& hit : hits) {
        const bool known = std::ranges::any_of(first, [&hit](const NameHit& other) {
            return other.who == hit.who &&
                   (other.kind == hit.kind || (other.begin <= hit.begin && hit.end <= other.end));
        });
        if (!known) first.push_back(hit);
    }
    std::ranges::stable_sort(first, {}, &NameHit::begin);
    return first;
}

std::vector<Student> members_of(const fs::path& group_file) {
    std::vector<Student> members;
    if (!fs::is_regular_file(fs::symlink_status(group_file))) return members;
    const std::string text = read_text(group_file);
    try {
        const toml::table group = toml::parse(text);
        const toml::array* const names = group["members"].as_array();
        if (names == nullptr) return members;
        for (const toml::node& name : *names)
            if (const auto value = name.value<std::string>()) {
                Student member;
                member.name = *value;
                members.push_back(std::move(member));
            }
    } catch (const toml::parse_error&) {
        // What is wrong with the file is said where the report is made from it.
    }
    return members;
}

}  // namespace dynlab::inline course
