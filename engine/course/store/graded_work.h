#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

struct LaidOutWork {
    std::vector<std::string> groups;   ///< whose work is there
    std::vector<std::string> without;  ///< who handed in neither script nor pack
};

/// Lays out for `dynlab grade` what groups handed in at `stage` ("first", "final"): in `folder`, which is made, of each
/// group the newest script, as GROUP/analysis.lua, or pack, as GROUP.zip, whichever came last and was not withdrawn.
/// The files are as old as their versions, for deadlines. The folder appears with all of them or not at all. Throws
/// InvalidArgument for a folder that exists.
LaidOutWork lay_out_work(Course& course, const Assignment& assignment, const std::string& stage,
                         const std::filesystem::path& folder);

/// The scores that a gradebook of such work gives for one criterion: the share of the possible points, times the most
/// that the criterion gives, rounded to hundredths. Which is not graded whole is left out.
struct GradedScores {
    std::string csv;                    ///< as import_scores reads it
    std::vector<std::string> left_out;  ///< submissions
};
/// Throws EnvironmentError for a file that is no gradebook.csv, InvalidArgument for a criterion that is none.
GradedScores scores_of_gradebook(const Assignment& assignment, const std::string& stage,
                                 const std::filesystem::path& gradebook, const std::string& criterion);

}  // namespace dynlab::inline course
