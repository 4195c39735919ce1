#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "platform/box.h"

namespace dynlab::inline course {

/// The PDF that a pack brings.
struct PackedDocument {
    std::filesystem::path file;
    std::string name;  ///< its path in the pack
};

/// Unpacks a pack into `to`, an empty folder that is made, in a box by `program`, and finds the PDF that is its
/// `part` ("report", "slides", "review"): the one of that name that lies highest, or the only one. Nothing where there
/// is none, or several could be meant. Throws SubmissionError for a pack that cannot be unpacked.
std::optional<PackedDocument> document_in_pack(const std::filesystem::path& pack, const std::string& part,
                                               const std::filesystem::path& to, Isolation level,
                                               const std::filesystem::path& program);

}  // namespace dynlab::inline course
