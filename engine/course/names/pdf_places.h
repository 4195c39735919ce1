#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "base/message.h"
#include "course/names/sought_names.h"

class QPDF;

namespace dynlab::inline course {

struct KnownFonts;

/// Where in a PDF something stands.
enum class PdfPlace {
    kText,        ///< what is printed, seen or not
    kHidden,      ///< outside of the page, in a layer that is off, in a part that is never shown
    kMetadata,    ///< document information, XMP, also of a figure
    kAttachment,  ///< an embedded file, its name, or what is in it
    kAnnotation,  ///< a comment: its author, its text
    kForm,        ///< a form's field
    kLink,        ///< the target of a link or another action
    kBookmark,
    kLayer,       ///< the name of one
    kImage,       ///< metadata of a picture
    kFigureFile,  ///< the name of the file that a figure was read from
    kRemains,     ///< an earlier state of the file, what nothing refers to, what stands behind its end
    kInside       ///< any other object
};

struct PlacedText {
    PdfPlace place = PdfPlace::kInside;
    int page = 0;        ///< 1-based; 0 when it belongs to no page
    std::string detail;  ///< "Author", a file's name; may be empty
    std::string text;
    TextManner manner = TextManner::kData;
};

using PlaceVisitor = std::function<void(const PlacedText&)>;
/// Takes an embedded file that is a PDF itself.
using NestedVisitor = std::function<void(const std::string& name, const std::string& bytes)>;

/// Everything in a PDF that may hold a name, besides what poppler reads on its pages. `file` the bytes themselves, for
/// what no object holds. Meant for work_on_pdf_objects. Composite fonts (ISO 32000-1, 9.7) whose codes are the numbers
/// of their letters, by name or by a CMap of the identity, and simple TrueType fonts (9.6.3) are read by what they
/// draw, too, as `known` fonts draw it. Returns a sentence when something was not looked at: a stream of more than
/// `most` bytes, too many fonts whose codes a content might be written in, an embedded composite font with another
/// CMap, a font that does not tell its letters; else an empty one.
Message visit_places(QPDF& pdf, const std::string& file, std::uint64_t most, const KnownFonts& known,
                     const PlaceVisitor& visit, const NestedVisitor& nested);

/// Changes the PDF so that poppler reads what lies outside of the pages and in layers that are off.
void show_everything(QPDF& pdf);

}  // namespace dynlab::inline course
