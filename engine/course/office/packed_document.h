#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/message.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// The PDF that a pack brings.
struct PackedDocument {
    std::filesystem::path file;
    std::string name;   ///< its path in the pack
    bool made = false;  ///< it was made here, as the pack has none
};

struct OpenedPack {
    std::optional<PackedDocument> document;
    Message missing;  ///< where there is none, a clause: "no PDF in the pack"
};

/// Unpacks a pack into `to`/pack with `program` in a sandbox, and finds the PDF that is its `part` ("report", "slides",
/// "review"): the PDF of that name at the highest level, or the only one. If there is no PDF, it is created from the
/// pack's analysis and text, in a sandbox as well. Throws SubmissionError for a pack that cannot be unpacked.
OpenedPack open_pack(const std::filesystem::path& pack, const std::string& part, const std::filesystem::path& to,
                     Isolation level, const std::filesystem::path& program);

/// The points that the script of a review (report_templates/peer_review.lua) gives, by criterion: the entries NAME =
/// NUMBER of its table `scores`. dynlab reads the script and does not run it; other entries give no points.
std::map<std::string, double> scores_in_script(std::string_view script);

/// The same of the analysis.lua that lies highest in an unpacked pack; nothing where there is none.
std::map<std::string, double> scores_in_pack(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
