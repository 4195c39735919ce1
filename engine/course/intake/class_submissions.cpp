#include "course/intake/class_submissions.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

ClassSubmissions::ClassSubmissions(const fs::path& folder_or_zip, Isolation isolation, const fs::path& program,
                                   const fs::path& results) {
    fs::path folder = folder_or_zip;
    if (fs::is_regular_file(folder_or_zip)) {
        folder = unpacked_.path() / "all";
        left_out_ = unpack_export(folder_or_zip, folder, isolation, program);
    }
    all_ = submissions_in(folder, left_out_, results);
}

}  // namespace dynlab::inline course
