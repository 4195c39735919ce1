#pragma once
#include <filesystem>
#include <vector>

#include "course/intake/submission.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// The submissions of a class as `dynlab grade` takes them: those in a folder, or in the one zip in which a platform
/// exports all of them. The zip is unpacked in a sandbox; what came out of it lives as long as this object.
class ClassSubmissions {
  public:
    /// `program`: dynlab. `results`: a folder that is no submission wherever it lies. Throws EnvironmentError where
    /// there are no submissions or the zip cannot be read.
    ClassSubmissions(const std::filesystem::path& folder_or_zip, Isolation isolation,
                     const std::filesystem::path& program, const std::filesystem::path& results = {});

    const std::vector<Submission>& all() const { return all_; }
    const std::vector<Message>& left_out() const { return left_out_; }  ///< what is no submission, a clause each

  private:
    TemporaryFolder unpacked_;
    std::vector<Message> left_out_;
    std::vector<Submission> all_;
};

}  // namespace dynlab::inline course
