#pragma once
#include <string>

namespace dynlab::inline documents {

/// The same PDF with its compressed streams written out, fonts, pages and packed objects, and without the paths that
/// pages and figures draw (content_paths.h), unless the page's content lies in several streams; pictures and embedded
/// files stay as they are. poppler reads the same text in it in a fraction of the time, as it inflates slowly, each
/// font again for each page, and follows each line of a figure. A file that is encrypted, or damaged in any way that
/// libqpdf notices, comes back as it is; so stays each stream that cannot be decoded, whose data lie elsewhere, and
/// what is beyond 64 MB.
std::string with_plain_streams(std::string pdf);

}  // namespace dynlab::inline documents
