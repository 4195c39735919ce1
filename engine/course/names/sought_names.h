#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "course/intake/roster.h"
#include "course/names/name_patterns.h"

namespace dynlab::inline course {

/// How a text is to be read when names are looked for in it.
enum class TextManner {
    kProse,  ///< sentences: a name that is also a word counts with its capital only
    kData,   ///< metadata, file names, links: case is not kept
    kBytes   ///< bytes that may spell anything by chance: long patterns only
};

struct NameHit {
    std::string who;  ///< as the roster has it, or the path
    NameKind kind = NameKind::kName;
    bool certain = true;             ///< else somebody else may be meant: a cited author, a given name
    std::size_t begin = 0, end = 0;  ///< bytes of the text
};

/// Whom a document must not name, and how their names, numbers, mail addresses and home folders are written.
///
/// A full name is found in any order and case, with or without accents and umlauts written out, hyphenated, spaced or
/// joined, with an initial between. A surname alone counts when it has four letters and is neither an ordinary word nor
/// a name of the field ("Park", "Young", "Laplace" count together with the given name only); with other initials before
/// it, "et al." or a year behind it, it is that of a cited author and uncertain; so it is in small letters, but not
/// within an identifier or a path (fig_lovelace.pdf). Initials alone never count. Of the document's own authors more is
/// looked for: given names alone (uncertain, but in an identifier or a path), two of them together ("Wu & Li", "Ada and
/// Grace"), short names with an initial ("B. Li", "Ada L."). A number counts from six digits on, also in groups ("2021
/// 4711") or behind the letters of an account ("s20214711"), or from five letters and digits; a shorter one when a word
/// such as "student" or "ID" stands before it, and one of fewer than three never. A group's name counts with other
/// words for a group, and without its zeros ("Group 1") as uncertain where it is not the authors' own. Home folders
/// (/home/NAME, C:\Users\NAME, the prompt NAME@HOST:~) count whoever's they are. Letters that look like others are read
/// as those.
class SoughtNames {
  public:
    SoughtNames() = default;
    explicit SoughtNames(const Roster& roster);
    /// `own`: of the document's authors.
    void add(const Student& student, bool own = false);
    /// The account that documents are made with: its home folder and its name in paths.
    void add_account(const std::filesystem::path& home);

    bool empty() const { return people_ == 0; }  ///< nobody is known; home folders are found nevertheless
    std::size_t people() const { return people_; }
    /// In order of their offsets; each person and kind once, what is certain before what is not.
    std::vector<NameHit> find(std::string_view utf8, TextManner manner) const;

  private:
    using Tokens = std::vector<NameToken>;
    void add_writings(const Student& student, bool own);
    void index(NamePattern pattern);
    void find_patterns(const Tokens& tokens, std::string_view text, TextManner manner,
                       std::vector<NameHit>& hits) const;
    void find_addresses(std::string_view text, std::vector<NameHit>& hits) const;
    void find_paths(std::string_view text, std::vector<NameHit>& hits) const;
    void find_prompts(std::string_view text, std::vector<NameHit>& hits) const;

    std::size_t people_ = 0;
    std::array<std::vector<NamePattern>, 256> patterns_;          ///< by the first byte of their letters
    std::vector<std::pair<std::string, std::string>> addresses_;  ///< folded, whose
    std::vector<std::string> homes_;
    std::vector<Student> authors_;  ///< own ones
};

/// Those whom the group.toml of a student's folder names as `members`; nobody where there is none or it cannot be read.
std::vector<Student> members_of(const std::filesystem::path& group_file);

}  // namespace dynlab::inline course
