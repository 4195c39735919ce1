#include "course/anonymity/anonymity_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "course/anonymity/drawn_letters.h"
#include "course/anonymity/pdf_places.h"
#include "platform/text/plain_words.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/message_values.h"
#include "documents/work_file.h"
#include "platform/temporary_folder.h"
#include "platform/text/shown_order.h"

namespace dynlab::inline course {

constexpr std::array<const char*, 13> names_of(PdfPlace) {
    return {"text",     "hidden", "metadata", "attachment",  "annotation", "form",  "link",
            "bookmark", "layer",  "image",    "figure_file", "remains",    "inside"};
}

constexpr std::array<const char*, 5> names_of(NameKind) {
    return {"name", "number", "mail", "group", "home"};
}

DYNLAB_DESCRIBE(NameHit, who, kind, certain, begin, end)

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNested = 5, kMostVersions = 5, kMostFindings = 40;
constexpr double kNameGap = 0.2;  ///< of the size: more is a space
constexpr const char* kEndMark = "%%EOF";

struct PlaceWords {
    const char* id;
    Message where, remedy;
};
/// By PdfPlace.
const PlaceWords& words_of(PdfPlace place) {
    static const std::array<PlaceWords, 13> places = {{
        {"name-in-text", Message("in the text"), Message("Take it out: reports are read anonymously.")},
        {"name-hidden",
         Message("where no reader sees it (outside of the page, in a hidden layer or in a part not shown)"),
         Message("Take it out of the source; what is cut away or covered is still in the file.")},
        {"name-in-metadata", Message("in the metadata"),
         Message(
             "Make the PDF with dynlab report, or empty author, title and keywords in the properties of the document "
             "and of its figures.")},
        {"name-in-attachment", Message("in an embedded file"), Message("Save the PDF without embedded files.")},
        {"name-in-annotation", Message("in a comment"),
         Message("Delete the comments, or print them away into a new PDF.")},
        {"name-in-form", Message("in a form's field"),
         Message("Empty the field, or print the document into a new PDF.")},
        {"name-in-link", Message("in the target of a link"), Message("Take the link out or let it lead elsewhere.")},
        {"name-in-bookmark", Message("in a bookmark"),
         Message("Change the heading, or save the PDF without bookmarks.")},
        {"name-in-layer", Message("in the name of a layer"),
         Message("Rename the layer or save the figure without layers.")},
        {"name-in-image", Message("in the metadata of a picture"),
         Message("Save the picture without metadata, such as by exporting it as PNG, and make the PDF again.")},
        {"name-in-figure-file", Message("in the path of a figure's file"),
         Message("Give the figure's file another name or place and make the PDF again, best with dynlab report.")},
        {"name-in-remains", Message("in what remains of an earlier state of the file, or behind its end"),
         Message("Make the PDF anew instead of changing it, best with dynlab report.")},
        {"name-inside", Message("inside the file, in a part that is never printed"),
         Message("Make the PDF anew with dynlab report, or print it into a new PDF.")},
    }};
    return places[static_cast<std::size_t>(place)];
}

/// Something found, still without words.
struct Found {
    PdfPlace place = PdfPlace::kText;
    int page = 0;
    std::string detail, excerpt;
    NameHit hit;
};

/// What is found inside of a PDF.
struct SearchedObjects {
    std::vector<Found> found;
    std::vector<std::string> authors, nested;  ///< nested: PDFs embedded in it
    Message trouble;
    std::string shown;  ///< the PDF with everything shown
};

DYNLAB_DESCRIBE(Found, place, page, detail, excerpt, hit)
DYNLAB_DESCRIBE(SearchedObjects, found, authors, nested, trouble, shown)

Message sentence_about(const NameHit& hit, const Message& where, const std::string& excerpt) {
    const std::string who = printable(hit.who, 80);
    const bool sure = hit.certain;
    switch (hit.kind) {
        case NameKind::kNumber:
            return sure ? Message("The number of {} stands {}: \"{}\".", who, where, excerpt)
                        : Message("The number of {} stands {}: \"{}\"; somebody else may be meant.", who, where,
                                  excerpt);
        case NameKind::kMail:
            return sure ? Message("The mail address or account of {} stands {}: \"{}\".", who, where, excerpt)
                        : Message("The mail address or account of {} stands {}: \"{}\"; somebody else may be meant.",
                                  who, where, excerpt);
        case NameKind::kGroup:
            return sure ? Message("The group {} stands {}: \"{}\".", who, where, excerpt)
                        : Message("The group {} stands {}: \"{}\"; somebody else may be meant.", who, where, excerpt);
        case NameKind::kHome:
            return sure ? Message("A home folder stands {}: \"{}\".", where, excerpt)
                        : Message("A home folder stands {}: \"{}\"; somebody else may be meant.", where, excerpt);
        case NameKind::kName:
            break;
    }
    return sure ? Message("The name of {} stands {}: \"{}\".", who, where, excerpt)
                : Message("The name of {} stands {}: \"{}\"; somebody else may be meant.", who, where, excerpt);
}

Finding finding_of(const Found& found) {
    const PlaceWords& words = words_of(found.place);
    const Message where =
        found.detail.empty() ? words.where : Message("{} ({})", words.where, printable(found.detail, 40));
    return {words.id, found.hit.certain ? Severity::kRule : Severity::kHint,          found.page,
            "",       sentence_about(found.hit, where, printable(found.excerpt, 60)), words.remedy};
}

std::string excerpt_of(const std::string& text, const NameHit& hit) {
    std::string excerpt = text.substr(hit.begin, hit.end - hit.begin);
    std::replace(excerpt.begin(), excerpt.end(), '\n', ' ');
    return printable(excerpt, 80);
}

/// The text of a page as a reader meets it, lines apart; turned text and code too.
std::string page_text(const PdfPage& page) {
    std::string text;
    const PdfWord* last = nullptr;
    for (const PdfWord& word : page.words) {
        if (last) {
            const double height = std::max(last->bottom - last->top, 1.0);
            const bool new_line = !word.rotated && std::abs(word.bottom - last->bottom) > 0.7 * height;
            const bool apart = last->space_after || word.rotated ||
                               std::abs(word.left - last->right) > kNameGap * std::max(word.size, 1.0);
            text += new_line ? "\n" : apart ? " " : "";
        }
        text += word.text;
        last = &word;
    }
    return text;
}

/// One file's search: its pages, its objects, its earlier versions and the PDFs in it.
class NameSearch {
  public:
    NameSearch(const IdentityMatcher& sought, const NameSearchLimits& limits) : sought_(sought), limits_(limits) {}

    void search(const fs::path& file, const PdfLayout& layout) {
        search_pages(layout, PdfPlace::kText);
        search_inside(file, true);
    }

    Findings findings() {
        drop_echoes();
        Findings result;
        for (std::size_t i = 0; i < found_.size() && i < kMostFindings; ++i) result.push_back(finding_of(found_[i]));
        if (found_.size() > kMostFindings)
            result.push_back({"names-not-listed", Severity::kRule, 0, "",
                              Message("{} further places that name somebody, or may do so, are not listed here.",
                                      found_.size() - kMostFindings),
                              Message("Mend what is listed and check the document again.")});
        if (!trouble_.empty())
            result.push_back({"not-searched", Severity::kRule, 0, "",
                              sentences({Message("The inside of the file cannot be searched for names."), trouble_}),
                              Message("Make the PDF anew, best with dynlab report.")});
        for (const std::string& author : authors_)
            result.push_back({"author-named", Severity::kHint, 0, "",
                              Message("The metadata name an author: \"{}\".", printable(author, 60)),
                              Message("Leave the author empty: reports are read anonymously.")});
        return result;
    }

  private:
    void search_pages(const PdfLayout& layout, PdfPlace place) {
        int number = 0;
        for (const PdfPage& page : layout.pages) {
            const std::string text = page_text(page);
            ++number;
            for (NameHit& hit : sought_.find(text, TextManner::kProse))
                found_.push_back({place, number, "", excerpt_of(text, hit), std::move(hit)});
        }
    }

    void search_inside(const fs::path& file, bool versions) {
        try {
            SearchedObjects read = searched_objects(file);
            std::move(read.found.begin(), read.found.end(), std::back_inserter(found_));
            authors_.insert(read.authors.begin(), read.authors.end());
            trouble_ = read.trouble;
            search_all_shown(read.shown);
            const std::vector<std::string>& nested = read.nested;
            for (std::size_t i = 0; i < nested.size() && i < kMostNested; ++i)
                search_nested(nested[i], PdfPlace::kAttachment);
            if (nested.size() > kMostNested) trouble_ = Message("More than {} PDFs are embedded in it.", kMostNested);
        } catch (const PdfRefusal& refusal) {
            trouble_ = refusal.message();
        }
        if (versions) search_versions(file);
    }

    SearchedObjects searched_objects(const fs::path& file) const {
        const KnownFonts& known = known_fonts();  // the process that searches reads no files
        const std::string answer = work_on_pdf_objects(file, limits_.objects, [&](QPDF& pdf, const std::string& bytes) {
            return cbor_of(found_in(pdf, bytes, known));
        });
        try {
            return from_cbor<SearchedObjects>(answer);
        } catch (const ValueError&) {
            throw PdfRefusal(PdfFault::kDamaged, Message("Searching it gives nothing that can be read."));
        }
    }

    SearchedObjects found_in(QPDF& pdf, const std::string& bytes, const KnownFonts& known) const {
        SearchedObjects read;
        read.trouble = visit_places(
            pdf, bytes, limits_.objects.bytes_inside, known,
            [&](const PlacedText& placed) {
                const std::size_t before = read.found.size();
                const auto look_into = [&](const std::string& text) {
                    for (const NameHit& hit : sought_.find(text, placed.manner))
                        read.found.push_back({placed.place, placed.page, placed.detail, excerpt_of(text, hit), hit});
                };
                look_into(placed.text);
                if (const std::string shown = in_shown_order(placed.text); shown != placed.text) look_into(shown);
                const bool author = placed.place == PdfPlace::kMetadata && placed.detail == "Author";
                if (author && read.found.size() == before && !plain_words(placed.text).empty())
                    read.authors.push_back(printable(placed.text, 200));
            },
            [&](const std::string&, const std::string& inner) {
                if (read.nested.size() <= kMostNested) read.nested.push_back(inner);
            });
        show_everything(pdf);
        read.shown = written_pdf(pdf, limits_.objects.bytes_inside);
        return read;
    }

    template <class Bytes>
    fs::path written(const char* name, const Bytes& bytes) const {
        const fs::path file = work_.path() / name;
        write_work_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        return file;
    }

    template <class Bytes>
    void search_all_shown(const Bytes& pdf) {
        search_pages(read_pdf_layout(written("shown.pdf", pdf), limits_.pdf), PdfPlace::kHidden);
    }

    /// A PDF inside of this one, or an earlier version of it: all that is found there counts as `place`.
    template <class Bytes>
    void search_nested(const Bytes& bytes, PdfPlace place) {
        const fs::path file = written("nested.pdf", bytes);
        NameSearch inner(sought_, limits_);
        try {
            inner.search_pages(read_pdf_layout(file, limits_.pdf), PdfPlace::kText);
        } catch (const PdfRefusal&) {
            // A piece of a file need not be one; what can be read in it is searched below and with the whole file.
        }
        inner.search_inside(file, false);
        for (Found& one : inner.found_) {
            one.place = place;
            one.page = 0;
            found_.push_back(std::move(one));
        }
    }

    /// Programs that change a PDF append to it: each end mark is the end of an earlier version.
    void search_versions(const fs::path& file) {
        const std::string bytes = read_work_file(file);
        std::vector<std::size_t> ends;
        for (std::size_t at = bytes.find(kEndMark); at != std::string::npos; at = bytes.find(kEndMark, at + 1))
            ends.push_back(at + std::char_traits<char>::length(kEndMark));
        if (!ends.empty()) ends.pop_back();
        const bool linearised = bytes.substr(0, 1024).find("/Linearized") != std::string::npos;
        if (linearised && !ends.empty()) ends.erase(ends.begin());
        for (std::size_t i = 0; i < ends.size() && i < kMostVersions; ++i)
            search_nested(bytes.substr(0, ends[ends.size() - 1 - i]), PdfPlace::kRemains);
    }

    /// Each person once at each place of each page, and in the nets only who was not found elsewhere. What is certain
    /// comes first, so that no number of hints can push it off the list.
    void drop_echoes() {
        const auto is_net = [](const Found& found) {
            return found.place == PdfPlace::kHidden || found.place == PdfPlace::kRemains ||
                   found.place == PdfPlace::kInside;
        };
        std::stable_sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) {
            return std::pair(!a.hit.certain, is_net(a)) < std::pair(!b.hit.certain, is_net(b));
        });
        std::set<std::string> named;
        std::set<std::tuple<std::string, PdfPlace, int, NameKind>> placed;
        std::vector<Found> kept;
        for (Found& found : found_) {
            const bool first = named.insert(found.hit.who).second;
            const bool first_here = placed.emplace(found.hit.who, found.place, found.page, found.hit.kind).second;
            if (is_net(found) ? first : first_here) kept.push_back(std::move(found));
        }
        found_ = std::move(kept);
    }

    const IdentityMatcher& sought_;
    const NameSearchLimits& limits_;
    std::vector<Found> found_;
    std::set<std::string> authors_;
    Message trouble_;
    TemporaryFolder work_;
};

}  // namespace

Findings name_findings(const fs::path& file, const PdfLayout& layout, const IdentityMatcher& sought,
                       const NameSearchLimits& limits) {
    NameSearch search(sought, limits);
    search.search(file, layout);
    return search.findings();
}

}  // namespace dynlab::inline course
