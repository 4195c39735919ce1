#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace dynlab::inline course {

/// The points that the script of a review (report_templates/peer_review.lua) gives, by criterion: the entries NAME =
/// NUMBER of its table `scores`. The script is read, not run; whatever else stands there gives nothing.
std::map<std::string, double> scores_in_script(std::string_view script);

/// The same of the analysis.lua that lies highest in an unpacked pack; nothing where there is none.
std::map<std::string, double> scores_in_pack(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
