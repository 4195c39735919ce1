#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "documents/percent_script.h"
#include "scripting/runtime/services.h"
#include "workflow/parts/part.h"

namespace dynlab::inline workflow {

/// A study: a script whose calls of montecarlo are made in parts, by as many runs of it. A run goes on behind a call
/// only when all parts of that are there. What a part gave is a file of the folder, named by a digest of all that it
/// depends on: program, script, seed, the files that the script has read, and the call's place among such calls.
class StudyParts : public CallsInParts {
  public:
    /// With a part, makes what is missing of it; without, nothing.
    StudyParts(std::filesystem::path folder, const PercentScript& script, std::uint32_t seed, int count,
               std::optional<WorkPart> part);

    std::vector<std::string> all(const std::vector<std::filesystem::path>& files, std::size_t pieces,
                                 const Some& some) override;

    /// Of the first call that is not complete; none where the script needed no more.
    const MissingParts& missing() const { return missing_; }

  private:
    std::filesystem::path folder_;
    std::string study_;
    int count_;
    std::optional<WorkPart> part_;
    MissingParts missing_;
};

/// Runs the script quietly until a part is missing, and returns the missing parts. With a part, computes its share of
/// the first incomplete call. Throws EnvironmentError with the script's error.
MissingParts run_study_part(const PercentScript& script, std::uint32_t seed, const std::filesystem::path& folder,
                            int count, std::optional<WorkPart> part);

}  // namespace dynlab::inline workflow
