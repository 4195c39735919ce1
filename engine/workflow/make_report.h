#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "documents/document.h"
#include "documents/percent_script.h"
#include "documents/unplaced_entries.h"
#include "platform/cache.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline workflow {

/// What a report is made of and where it goes.
struct ReportRequest {
    PercentScript script;
    std::filesystem::path template_file;
    std::map<std::string, std::string>
        metadata;  ///< title, subtitle and language of a lesson; empty for a student's report
    enum class Shows { kCells, kText, kNothing };
    Shows shows = Shows::kCells;     ///< of the script: text, code and output, or text alone, or nothing
    MarkdownText last_section = {};  ///< follows the cells
    std::filesystem::path output;    ///< .pdf, .html or .md
    std::filesystem::path record;  ///< where what the run gave is written, too, as JSON (documents/run_record.h); such
                                   ///< a report is always created again
    std::uint32_t seed = 1;
    std::map<std::string, double> slider_values;  ///< instead of what the script gives its sliders
    bool of_lesson = false;                    ///< the user cannot change the text: unplaced entries are not reported
    bool stay_in_folder = false;               ///< the script reads files of its folder and the installed data only
    std::function<void(const Message&)> step;  ///< called with each step as it begins; may be empty
    std::function<void(const Message&)> enter_cell;  ///< called with each cell of the script as it begins
    std::function<void(const std::string&)> print;   ///< sees what the script prints; such a report is always created
                                                     ///< again, and not at all where the script fails
};

/// The document of a request, filled from its run results, which must outlive it.
DocumentSource document_source(const ReportRequest& request, const RunRecord& record);

/// The step of the timings that the cells' own are part of.
inline constexpr const char* kRunStep = "run the script";

struct ReportResult {
    bool up_to_date = false;       ///< nothing had changed, nothing was made
    std::optional<Message> error;  ///< the script stopped with it; the report says so
    std::vector<Message> gaps;     ///< what points to nothing, with its place: the report is a draft, with ?? there
    std::vector<Message> notes;    ///< about letters that pdflatex does not have
    std::vector<UnplacedEntries> unplaced;                ///< what was reported and is not shown
    std::vector<std::pair<std::string, double>> timings;  ///< seconds of each step
    std::vector<std::pair<std::string, double>> cells;    ///< seconds of each code cell, when the script was run
    std::optional<CacheUse> long_calls, figures;          ///< of the script, when it was run
};

/// The report of a lesson (`name`, any unique beginning: its reference solution), of a student's folder (analysis.lua
/// and report.md; the group's seed from group.toml) or of a script. A lesson is woven, or fills the report.LANGUAGE.md
/// in its folder. Without `output`, a lesson's report goes to the current folder (02_least_squares.pdf), a folder's
/// into the folder (report.pdf), a script's next to the script (FILE.pdf). The default of `language` is the language of
/// the script; a folder's language is in its report.md. Throws EnvironmentError for a folder without these files, a
/// lesson without a report in the requested language, or a language given with a folder or script.
ReportRequest report_of(const std::string& subject, const std::filesystem::path& output = {},
                        const std::string& language = {});
/// The task sheet of a lesson: its text, data and code without the solutions, as students get it, with the places for
/// their answers, in `language` unless empty. Without `output` it goes to the current folder:
/// 02_least_squares_sheet.pdf. Throws EnvironmentError for a lesson without tasks in that language.
ReportRequest sheet_of(const std::string& lesson, const std::filesystem::path& output = {},
                       const std::string& language = {});
/// The questions that a talk on the lesson may raise (its talk.md: a heading `# Question?` each, then the answer), with
/// the model answers for the instructor; default: 05_thruster_talk.pdf. Slots in the answers are filled from a run of
/// the reference solution. Throws EnvironmentError for a lesson without such questions.
ReportRequest talk_sheet_of(const std::string& lesson, bool with_answers, const std::filesystem::path& output = {});
/// The model answers of a lesson for students who have submitted: the text with the reference solutions, figures and
/// tables, without code and printed output, or the report in the same folder in `language` if there is one.
ReportRequest model_answers_of(const Lesson& lesson, const std::filesystem::path& output,
                               const std::string& language = {});
/// The report of any script, with the template its header names, or that of lessons when it has no place for cells.
ReportRequest report_of_script(const PercentScript& script, const std::filesystem::path& output);

/// What the run of a script reported and its report would not show: the text is report.md beside analysis.lua, that of
/// the cells for any other script with text. Nothing of a run that failed and of a lesson's master.
std::vector<UnplacedEntries> entries_without_place(const PercentScript& script, const RunRecord& record);

/// Runs the script and makes the document; `output` is written completely or stays unchanged. With unchanged inputs
/// (script, template, data, seed, program) and an unmodified output, nothing is done; with unchanged code and data, the
/// script is not run again. If the script stops with an error, the report shows the results up to there, and the error
/// at its place; a slot or a reference without a target is shown as a bold ??. Throws DocumentError if no document can
/// be made.
ReportResult make_report(const ReportRequest& request);

}  // namespace dynlab::inline workflow
