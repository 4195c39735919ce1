#pragma once
#include <set>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// What a question is called: its number ("3"), or the title of a section of the report ("Conclusion"). Only letters
/// and digits of a title count.
struct QuestionName {
    int number = 0;                     ///< 0 for a section
    std::set<std::string> titles = {};  ///< of a section: in all languages, folded by folded_title()
};

/// The text of a submission in the order in which it is read.
struct TextPart {
    std::string id;                  ///< of a text cell
    std::vector<std::string> lines;  ///< Markdown
};
/// The text cells of a script (analysis.lua). Lenient: the script need not run.
std::vector<TextPart> text_parts_of_script(const std::string& source);
/// The text of report.md without header and comments.
std::vector<TextPart> text_parts_of_report(const std::string& markdown);

/// What a lesson gives to all students, as opposed to what they write.
class GivenText {
  public:
    void add(const std::vector<TextPart>& parts);
    bool has_line(const std::string& line) const;            ///< of some length: short lines are in every text
    bool has_paragraph(const std::string& paragraph) const;  ///< wherever its lines are broken
    bool has_heading(const std::string& line) const;
    const std::set<int>& questions() const { return questions_; }                ///< their numbers
    const std::vector<std::string>& headings() const { return headings_list_; }  ///< as they are written

  private:
    std::set<std::string> lines_, paragraphs_, headings_;
    std::vector<std::string> headings_list_;
    std::set<int> questions_;
};

/// What the parts hold for one question, without what is given; empty where it was not answered. A question begins with
/// a line "**Question 3.** ...", a heading "# Question 3" or a text cell `id=q3`, and ends with the next question or a
/// heading of the lesson; a section ends with the next heading of its level or above.
std::string written_answer(const std::vector<TextPart>& parts, const QuestionName& question, const GivenText& given);

/// Folded letters and numbers of a heading, without "#", its number and its attributes.
std::string folded_title(const std::string& heading);

/// Answers that say the same: the first is shown for all.
struct AnswerGroup {
    std::vector<std::size_t> members;      ///< places in the list
    std::vector<std::string> differences;  ///< of each member from the first: "+very -quite"; empty for equal ones
};

/// Groups equal answers, and those of eight and more words with the same formulas, code and numbers in which nine of
/// ten words are the same. In the order of their first members; empty answers are in no group.
std::vector<AnswerGroup> groups_of_answers(const std::vector<std::string>& answers);

}  // namespace dynlab::inline course
