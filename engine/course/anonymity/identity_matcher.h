#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "course/anonymity/pattern_matcher.h"

namespace dynlab::inline course {

struct NameHit {
    std::string who;  ///< as in the roster, or the path
    NameKind kind = NameKind::kName;
    bool certain = true;    ///< else another person may be meant: a cited author, a given name
    bool ordinary = false;  ///< the name is an ordinary word, too; never certain
    std::string written;    ///< in the text
    std::size_t begin = 0, end = 0;
};

/// Finds people in text: names, numbers, mail addresses, groups and home folders.
///
/// A full name is found in any order and case, with or without accents and umlauts written out, hyphenated, spaced or
/// joined, with an initial between. A surname alone counts from four letters. If it is an ordinary word or a name of
/// the field ("Park", "Laplace"), it is found with its capital within a sentence, never certain, and only for the
/// document's authors where these are known. With other initials before it, "et al." or a year after it, a surname is
/// that of a cited author and not certain; it is passed over where the bibliography of a lesson has this author. A
/// surname in small letters is not certain except in an identifier or a path (fig_lovelace.pdf). Initials alone never
/// count. For the document's authors more counts: given names alone (not certain, except in an identifier or a path),
/// two authors together ("Wu & Li"), short names with an initial ("B. Li", "Ada L."). A number counts from six digits,
/// also in groups ("2021 4711") or after letters ("s20214711"), or from five letters and digits; a shorter one only
/// after a word such as "student". A group counts with other words for a group; one whose name is a single word without
/// a number only for the authors, and not if the word is an ordinary one; without its zeros ("Group 1") it is certain
/// only for the authors. Home folders (/home/NAME, C:\Users\NAME, NAME@HOST:~) always count. Percent-encoded and
/// compatibility forms are decoded first; letters of other scripts count as the Latin ones they look like. White space
/// within a word does not matter.
class IdentityMatcher {
  public:
    IdentityMatcher() = default;
    explicit IdentityMatcher(const std::vector<Student>& students);
    /// `own`: an author of the document.
    void add(const Student& student, bool own = false);
    /// The account that makes documents: its home folder.
    void add_account(const std::filesystem::path& home);
    /// Authors of literature, who are not students.
    void add_cited(const std::vector<CitedAuthor>& authors);

    bool empty() const { return people_ == 0; }  ///< home folders are found nevertheless
    std::size_t people() const { return people_; }
    /// In order of their offsets; each person and kind once, certain hits before others.
    std::vector<NameHit> find(std::string_view utf8, TextManner manner) const;

  private:
    using Tokens = std::vector<NameToken>;
    void add_writings(const Student& student, bool own);
    void index(NamePattern pattern);
    void find_patterns(const Tokens& tokens, std::string_view text, TextManner manner,
                       std::vector<NameHit>& hits) const;
    void find_addresses(std::string_view text, std::vector<NameHit>& hits) const;
    void find_paths(std::string_view text, std::vector<NameHit>& hits) const;
    bool is_cited(const NamePattern& pattern, const Tokens& tokens, std::size_t first, std::size_t end) const;

    std::size_t people_ = 0;
    std::array<std::vector<NamePattern>, 256> patterns_;          ///< by the first byte of their letters
    std::vector<std::pair<std::string, std::string>> addresses_;  ///< folded, and whose
    std::vector<std::string> homes_;
    std::vector<Student> authors_;                        ///< of the document
    std::map<std::string, std::set<std::string>> cited_;  ///< given names and initials by surname
    std::set<std::string> cited_names_;                   ///< in full, joined
};

/// The `members` in the group.toml of a student's folder; none if there is no such file or it cannot be read.
std::vector<Student> members_of(const std::filesystem::path& group_file);

/// Authors and editors in the bibliographies (references.bib) of all lessons; read once.
const std::vector<CitedAuthor>& cited_authors();

}  // namespace dynlab::inline course
