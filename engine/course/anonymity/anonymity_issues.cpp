#include "course/anonymity/anonymity_issues.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <set>
#include <tuple>

#include "data_io/values/cbor_values.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {

enum class TextPlace { kText, kMetadata, kLink, kBookmark, kFileName };

constexpr std::array<const char*, 5> names_of(TextPlace) {
    return {"text", "metadata", "link", "bookmark", "file name"};
}

namespace {

namespace fs = std::filesystem;
using Object = QPDFObjectHandle;

constexpr std::size_t kMaxFindings = 40, kMaxWords = 6, kLinesAtBreak = 3;
constexpr int kSmallPicture = 40;        ///< pixels: no text fits into less
constexpr std::size_t kEmptyPage = 100;  ///< bytes of a page's content that draw nothing
constexpr double kNameGap = 0.2;         ///< of the font size: more is a space

/// Text in a PDF outside of its pages' content.
struct PlacedText {
    TextPlace place = TextPlace::kMetadata;
    int page = 0;
    std::string detail, text;
};

struct InsideOfPdf {
    std::vector<PlacedText> texts;
    std::vector<int> pictures, drawn;  ///< pages with pictures; pages with any content
};

DYNLAB_DESCRIBE(PlacedText, place, page, detail, text)
DYNLAB_DESCRIBE(InsideOfPdf, texts, pictures, drawn)

/// Each bookmark once, also where they are linked in a circle.
void add_bookmarks(Object bookmark, std::set<QPDFObjGen>& known, std::vector<PlacedText>& texts) {
    for (; bookmark.isDictionary(); bookmark = bookmark.getKey("/Next")) {
        if (bookmark.isIndirect() && !known.insert(bookmark.getObjGen()).second) return;
        if (Object title = bookmark.getKey("/Title"); title.isString())
            texts.push_back({TextPlace::kBookmark, 0, "", title.getUTF8Value()});
        add_bookmarks(bookmark.getKey("/First"), known, texts);
    }
}

bool has_any(Object resources, const char* kind) {
    return resources.isDictionary() && resources.getKey(kind).isDictionary() &&
           !resources.getKey(kind).getDictAsMap().empty();
}

/// Whether it may print words or pictures by a tiling pattern, in which readers of text do not look.
bool prints_by_pattern(Object resources, std::set<QPDFObjGen>& known) {
    if (has_any(resources, "/Pattern"))
        for (auto& [name, pattern] : resources.getKey("/Pattern").getDictAsMap()) {
            Object inside = Object(pattern).isStream() ? Object(pattern).getDict().getKey("/Resources") : Object();
            if (has_any(inside, "/Font") || has_any(inside, "/XObject")) return true;
        }
    if (!has_any(resources, "/XObject")) return false;
    for (auto& [name, form] : resources.getKey("/XObject").getDictAsMap())
        if (Object(form).isStream() && known.insert(Object(form).getObjGen()).second &&
            prints_by_pattern(Object(form).getDict().getKey("/Resources"), known))
            return true;
    return false;
}

void add_page(Object page, int number, std::uint64_t max_bytes, InsideOfPdf& read) {
    if (Object annotations = page.getKey("/Annots"); annotations.isArray())
        for (Object annotation : annotations.getArrayAsVector())
            if (annotation.isDictionary() && annotation.getKey("/A").isDictionary())
                if (Object target = annotation.getKey("/A").getKey("/URI"); target.isString())
                    read.texts.push_back({TextPlace::kLink, number, "", target.getUTF8Value()});
    bool picture = false;
    QPDFPageObjectHelper(page).forEachImage(true, [&](Object& image, Object&, const std::string&) {
        const auto size = [&](const char* key) {
            Object pixels = image.getDict().getKey(key);
            return pixels.isInteger() ? pixels.getIntValueAsInt() : 0;
        };
        picture = picture || std::min(size("/Width"), size("/Height")) >= kSmallPicture;
    });
    std::set<QPDFObjGen> forms;
    picture = picture || prints_by_pattern(QPDFPageObjectHelper(page).getAttribute("/Resources", false), forms);
    if (picture) read.pictures.push_back(number);
    std::size_t bytes = 0;
    for (const Object& content : page.getPageContents()) bytes += stream_content(content, max_bytes).bytes.size();
    if (bytes > kEmptyPage) read.drawn.push_back(number);
}

InsideOfPdf read_inside(const fs::path& file, const PdfObjectLimits& limits) {
    const std::string answer = work_on_pdf_objects(file, limits, [&](QPDF& pdf, const std::string&) {
        InsideOfPdf read;
        if (Object info = pdf.getTrailer().getKey("/Info"); info.isDictionary())
            for (auto& [key, value] : info.getDictAsMap())
                if (Object(value).isString())
                    read.texts.push_back({TextPlace::kMetadata, 0, key.substr(1), Object(value).getUTF8Value()});
        if (Object xmp = pdf.getRoot().getKey("/Metadata"); xmp.isStream())
            read.texts.push_back({TextPlace::kMetadata, 0, "XMP", stream_content(xmp, limits.bytes_inside).bytes});
        std::set<QPDFObjGen> bookmarks;
        add_bookmarks(pdf.getRoot().getKey("/Outlines"), bookmarks, read.texts);
        int number = 0;
        for (const Object& page : pdf.getAllPages()) add_page(page, ++number, limits.bytes_inside, read);
        return cbor_of(read);
    });
    try {
        return from_cbor<InsideOfPdf>(answer);
    } catch (const ValueError&) {
        throw PdfRefusal(PdfFault::kDamaged, Message("The file is damaged: its contents cannot be read."));
    }
}

/// The text of a page in reading order, line by line.
std::vector<std::string> page_lines(const PdfPage& page) {
    std::vector<std::string> lines;
    const PdfWord* last = nullptr;
    for (const PdfWord& word : page.words) {
        const double height = last != nullptr ? std::max(last->bottom - last->top, 1.0) : 1;
        const bool new_line = last == nullptr || (!word.rotated && std::abs(word.bottom - last->bottom) > 0.7 * height);
        if (new_line) {
            lines.emplace_back();
        } else if (last->space_after || word.rotated ||
                   std::abs(word.left - last->right) > kNameGap * std::max(word.size, 1.0)) {
            lines.back() += ' ';
        }
        lines.back() += word.text;
        last = &word;
    }
    return lines;
}

std::string text_of_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

struct PlaceText {
    const char* id;
    Message where, remedy;
};
/// By TextPlace.
const PlaceText& text_about(TextPlace place) {
    static const std::array<PlaceText, 5> places = {{
        {"name-in-text", Message("in the text"),
         Message("Remove this information, because reports are reviewed anonymously.")},
        {"name-in-metadata", Message("in the document information"),
         Message("Create the PDF with dynlab report, or clear author, title and keywords in the document properties.")},
        {"name-in-link", Message("in the target of a link"), Message("Remove the link or change its target.")},
        {"name-in-bookmark", Message("in a bookmark"),
         Message("Change the heading, or save the PDF without bookmarks.")},
        {"name-in-file-name", Message("in the file name"), Message("Rename the file before you submit it.")},
    }};
    return places[static_cast<std::size_t>(place)];
}

Message sentence_about(const NameHit& hit, const Message& where, const std::string& excerpt) {
    const std::string who = printable(hit.who, 80);
    const bool sure = hit.certain;
    switch (hit.kind) {
        case NameKind::kNumber:
            return sure ? Message("The id of {} appears {}: \"{}\".", who, where, excerpt)
                        : Message("The id of {} may appear {}: \"{}\".", who, where, excerpt);
        case NameKind::kMail:
            return sure ? Message("The email address or account of {} appears {}: \"{}\".", who, where, excerpt)
                        : Message("The email address or account of {} may appear {}: \"{}\".", who, where, excerpt);
        case NameKind::kGroup:
            return sure ? Message("The group name {} appears {}: \"{}\".", who, where, excerpt)
                        : Message("The group name {} may appear {}: \"{}\".", who, where, excerpt);
        case NameKind::kHome:
            return Message("A home folder appears {}: \"{}\".", where, excerpt);
        case NameKind::kName:
            break;
    }
    return sure ? Message("The name of {} appears {}: \"{}\".", who, where, excerpt)
                : Message("The name of {} may appear {}: \"{}\".", who, where, excerpt);
}

std::string excerpt_of(const NameHit& hit) {
    std::string excerpt = hit.written;
    std::ranges::replace(excerpt, '\n', ' ');
    return printable(excerpt, 60);
}

Message list_of_pages(const std::vector<int>& pages) {
    std::string list;
    for (const int page : pages) list += (list.empty() ? "" : ", ") + std::to_string(page);
    return Message::verbatim(list);
}

class AnonymitySearch {
  public:
    explicit AnonymitySearch(const IdentityMatcher& matcher) : matcher_(matcher) {}

    void search_pages(const PdfLayout& layout, const std::vector<std::string>& in_content_order) {
        std::vector<std::string> before;
        int number = 0;
        for (const PdfPage& page : layout.pages) {
            const std::vector<std::string> lines = page_lines(page);
            ++number;
            search({TextPlace::kText, number, "", text_of_lines(lines)}, TextManner::kProse);
            if (static_cast<std::size_t>(number) <= in_content_order.size())
                search({TextPlace::kText, number, "", in_content_order[static_cast<std::size_t>(number) - 1]},
                       TextManner::kProse);
            search_page_break(before, lines, number);
            before = lines;
        }
    }

    void search_source(const PdfLayout& layout) {
        only_beyond_ascii_ = true;
        search_pages(layout, {});
        only_beyond_ascii_ = false;
    }

    void search_inside(const fs::path& file, const PdfLayout& layout, const PdfObjectLimits& limits) {
        try {
            const InsideOfPdf read = read_inside(file, limits);
            for (const PlacedText& text : read.texts) {
                const bool found = search(text, TextManner::kData);
                if (text.detail == "Author" && !found && !plain_words(text.text).empty()) author_ = text.text;
            }
            std::set<int> pages(read.pictures.begin(), read.pictures.end());
            for (const int page : read.drawn)  // more pages than Poppler finds where the file miscounts them
                if (page > std::ssize(layout.pages) || layout.pages[static_cast<std::size_t>(page - 1)].words.empty())
                    pages.insert(page);
            unsearchable_.assign(pages.begin(), pages.end());
        } catch (const PdfRefusal& refusal) {
            error_reason_ = refusal.message();
        }
    }

    /// Groups name files after themselves: never certain.
    void search_name(const fs::path& file) {
        for (NameHit& hit : matcher_.find(file.stem().string(), TextManner::kData)) {
            hit.certain = false;
            add({TextPlace::kFileName, 0, "", ""}, hit);
        }
    }

    Issues findings() {
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Issue& a, const Issue& b) { return a.severity < b.severity; });
        Issues result(found_.begin(), found_.begin() + std::min(std::ssize(found_), std::ptrdiff_t{kMaxFindings}));
        if (found_.size() > kMaxFindings)
            result.push_back({"names-not-listed", Severity::kRule, 0, "",
                              plural(static_cast<std::int64_t>(found_.size() - kMaxFindings),
                                     "{} further place that contains, or may contain, a name is not listed here.",
                                     "{} further places that contain, or may contain, names are not listed here."),
                              Message("Correct the listed places and check the document again.")});
        if (!error_reason_.empty())
            result.push_back(
                {"not-searched", Severity::kRule, 0, "",
                 sentences({Message("Links and document information cannot be searched for names."), error_reason_}),
                 Message("Create the PDF again, preferably with dynlab report.")});
        if (!words_.empty())
            result.push_back(
                {"name-ordinary-word", Severity::kHint, first_word_, "",
                 Message("These words in the text are also names of students: {}.", Message::verbatim(words_)),
                 Message("Check whether the text refers to a student.")});
        if (!author_.empty())
            result.push_back({"author-named", Severity::kHint, 0, "",
                              Message("The document information contains an author: \"{}\".", printable(author_, 60)),
                              Message("Leave the author field empty, because reports are reviewed anonymously.")});
        if (!unsearchable_.empty() && !matcher_.empty())
            result.push_back({"not-searchable", Severity::kHint, unsearchable_.front(), "",
                              Message("Pictures, and pages without text, cannot be searched for names (pages: {}).",
                                      list_of_pages(unsearchable_)),
                              Message("Inspect these pages.")});
        return result;
    }

  private:
    /// Whether anything was found.
    bool search(const PlacedText& text, TextManner manner) {
        bool found = false;
        for (const NameHit& hit : matcher_.find(text.text, manner)) {
            found = true;
            add(text, hit);
        }
        return found;
    }

    /// A name that a page break divides, whatever footers and headers are between.
    void search_page_break(const std::vector<std::string>& before, const std::vector<std::string>& after, int page) {
        for (std::size_t i = 0; i < std::min(before.size(), kLinesAtBreak); ++i)
            for (std::size_t k = 0; k < std::min(after.size(), kLinesAtBreak); ++k) {
                const std::string& upper = before[before.size() - 1 - i];
                for (const NameHit& hit : matcher_.find(upper + "\n" + after[k], TextManner::kProse))
                    if (hit.begin < upper.size() && hit.end > upper.size() + 1)
                        add({TextPlace::kText, page, "", ""}, hit);
            }
    }

    /// Each person once at each place of each page.
    void add(const PlacedText& text, const NameHit& hit) {
        const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
        if (only_beyond_ascii_ && std::ranges::all_of(hit.written, is_ascii)) return;
        if (!known_.emplace(hit.who, text.place, text.page, hit.kind).second) return;
        if (hit.ordinary) return add_word(text.page, hit);
        const PlaceText& place = text_about(text.place);
        const Message where =
            text.detail.empty() ? place.where : Message("{} ({})", place.where, printable(text.detail, 40));
        found_.push_back({place.id, hit.certain ? Severity::kRule : Severity::kHint, text.page, "",
                          sentence_about(hit, where, excerpt_of(hit)), place.remedy});
    }

    void add_word(int page, const NameHit& hit) {
        if (!ordinary_.insert(hit.written).second || ordinary_.size() > kMaxWords) return;
        if (words_.empty()) first_word_ = page;
        words_ += (words_.empty() ? "\"" : ", \"") + printable(hit.written, 40) + "\" (" + std::to_string(page) + ")";
    }

    const IdentityMatcher& matcher_;
    Issues found_;
    std::set<std::tuple<std::string, TextPlace, int, NameKind>> known_;
    std::set<std::string> ordinary_;
    std::string words_, author_;
    int first_word_ = 0;
    bool only_beyond_ascii_ = false;
    std::vector<int> unsearchable_;
    Message error_reason_;
};

}  // namespace

Issues anonymity_findings(const fs::path& file, const PdfLayout& layout, const IdentityMatcher& matcher,
                          const PdfObjectLimits& limits, const PdfLayout* source) {
    AnonymitySearch search(matcher);
    search.search_pages(layout, text_in_content_order(file));
    if (source) search.search_source(*source);
    search.search_inside(file, layout, limits);
    search.search_name(file);
    return search.findings();
}

}  // namespace dynlab::inline course
