#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline course {

/// A JPEG (ITU-T T.81, annex B) taken apart.
struct JpegParts {
    std::string picture;  ///< the first picture and what it is shown by: tables, JFIF, colour profile, Adobe's mark
    std::string words;    ///< what can be read in comments, metadata and what stands between segments or behind the end
    std::string
        tables;  ///< the same of tables, reserved segments and the ends of scans: bytes, which may spell anything
};

/// Bytes that have no order of a JPEG are `picture` and `words` as a whole.
JpegParts parts_of_jpeg(std::string_view bytes);

}  // namespace dynlab::inline course
