#pragma once
#include <filesystem>
#include <string>

#include "documents/chunks/chunk_setter.h"
#include "workflow/lesson_catalog.h"
#include "workflow/site/site_page.h"

namespace dynlab::inline platform {
class Cache;
}

namespace dynlab::inline workflow {

/// A lesson in a site.
struct LessonPage {
    SitePage page;
    std::string description;  ///< lesson.json beside the page
};

/// Makes the pages of lessons from the student's copy: its prose, and for each code cell
///
///     <section class="cell" data-cell="ID" data-first="FIRST LINE" data-last="LAST LINE">
///     <pre class="code">source</pre><div class="results">printed text and figures of a run</div></section>
///
/// within <main id="lesson" data-root="../../" data-lesson="02_least_squares" data-file="analysis.lua"
/// data-language="en">. Lines are those of the student's script, which lesson.json holds:
///
///     {"lesson", "file", "language", "title", "files": [{"name", "text" or "base64"}], "data": [NAME],
///      "checks": {"checks.lua": text, "checks.LANGUAGE.po": text, "hints.md" or "hints.LANGUAGE.md": text}}
///
/// Solutions are in none of it: everything is made from the student's copy.
class LessonPages {
  public:
    /// Figures are drawn below `work_folder`. `cache` must outlive it. `runs`: the site has the engine.
    LessonPages(const std::filesystem::path& work_folder, const Cache& cache, bool runs)
        : work_folder_(work_folder), cache_(cache), runs_(runs) {}

    /// The page in `language`, below lessons/NUMBER or LANGUAGE/lessons/NUMBER. Throws DocumentError for a text that
    /// cannot be set.
    LessonPage make(const Lesson& lesson, const std::string& language, const std::string& number);

  private:
    const std::filesystem::path work_folder_;
    const Cache& cache_;
    const bool runs_;
    ChunkSetter setter_{true};
};

/// Languages in which a lesson has tasks, its own language first.
std::vector<std::string> languages_of(const Lesson& lesson);

/// The folder of each lesson in the site: its number ("02"), or its whole name where lessons share a number.
std::map<std::string, std::string> numbers_of(const std::vector<Lesson>& lessons);

}  // namespace dynlab::inline workflow
