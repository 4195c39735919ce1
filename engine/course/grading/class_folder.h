#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/deadlines.h"
#include "course/grading/grading_rules.h"
#include "course/grading/late_penalties.h"
#include "course/grading/work_item.h"
#include "course/intake/owners.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// Where the work of a class comes from when there is no course: a folder, or what a platform put into one zip, and
/// tables beside it.
struct ClassSources {
    std::filesystem::path submissions;
    std::optional<std::filesystem::path> roster, deadlines, owners;
    std::vector<std::string> only;  ///< submissions, by name, group, id or student; all when empty
    bool newest_counts = false;     ///< of several submissions of one student; else the best one
    std::string timezone;           ///< of deadlines and of times in zips: "Europe/Paris"; empty: this machine's
    std::optional<std::filesystem::path> times = {};  ///< the platform's times of receipt (intake/arrival_times.h)
    bool accept_late = false;  ///< penalties of half the points or more count (grading/late_penalties.h)
};

/// The work in such a folder.
class ClassFolder {
  public:
    /// `results` is passed over where it lies in the folder; a zip is unpacked as `setup` has it. Throws
    /// EnvironmentError: a list of owners without a roster, files that cannot be read, a name in `only` that matches no
    /// submission.
    ClassFolder(const ClassSources& sources, const std::filesystem::path& results, const GradingSetup& setup);
    ClassFolder(const ClassFolder&) = delete;  // owners know the students by their place
    ClassFolder& operator=(const ClassFolder&) = delete;

    const ClassWork& work() const { return work_; }

  private:
    void read_students(const ClassSources& sources);
    void address(WorkItem& item) const;
    void date(WorkItem& item);
    std::vector<std::string> names_of(const WorkItem& item) const;
    void complain_of_unused_rows(const std::vector<Submission>& submissions);
    std::vector<std::size_t> chosen(const std::vector<std::string>& names) const;
    bool matches(const WorkItem& item, const std::string& name) const;

    TemporaryFolder unpacked_;
    ClassWork work_;
    std::optional<Owners> owners_;
    Deadlines deadlines_;
    LatePenalties late_;
};

}  // namespace dynlab::inline course
