#include "course/names/pdf_places.h"

#include <algorithm>
#include <map>
#include <qpdf/QPDF.hh>
#include <qpdf/QUtil.hh>
#include <set>

#include "course/names/byte_text.h"
#include "course/names/content_text.h"
#include "course/names/drawn_letters.h"
#include "course/names/jpeg_parts.h"
#include "course/names/picture_samples.h"
#include "documents/pdf/inflate.h"
#include "documents/pdf/pdf_objects.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

using Object = QPDFObjectHandle;

constexpr int kDeepestPlace = 600;  ///< libqpdf reads 500 levels
constexpr std::size_t kMostMaps = 200, kMostInflated = 64u << 20;
constexpr std::size_t kMostSamples = 256u << 10;  ///< of a file's pictures: noise spells words, and takes its time

/// Whether bytes look like UTF-16 without its mark rather than like Latin letters: control characters, or every second
/// byte beyond ASCII.
bool may_be_units(std::string_view bytes) {
    std::size_t beyond = 0, control = 0;
    for (const char c : bytes) {
        beyond += static_cast<unsigned char>(c) >= 0x80;
        control += static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
    }
    return control > 0 || 2 * beyond >= bytes.size();
}

/// A text string of PDF (ISO 32000-1, 7.9.2), or what can be read in bytes that are none.
std::string unicode_of(Object value) {
    if (value.isName()) return value.getName().substr(1);
    if (!value.isString()) return "";
    const std::string bytes = value.getStringValue(), text = value.getUTF8Value();
    if (QUtil::is_utf16(bytes) || QUtil::is_explicit_utf8(bytes)) return text;
    const bool is_utf8 = characters_in(bytes).find(kNoCharacter) == std::u32string::npos;  // without its mark
    std::string again;
    const bool is_latin = QUtil::utf8_to_pdf_doc(text, again) && again == bytes;
    const std::string readable = is_utf8 || !is_latin || may_be_units(bytes) ? text_in(bytes) : "";
    return readable.empty() ? text : readable;
}

std::string text_of(Object dictionary, const char* key) {
    return unicode_of(dictionary.getKey(key));
}

bool has_any(Object dictionary, std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return dictionary.hasKey(key); });
}

/// What kind of thing a dictionary is, by its own entries.
PdfPlace place_in_pdf(Object dictionary, PdfPlace otherwise) {
    const std::string type = text_of(dictionary, "/Type"), subtype = text_of(dictionary, "/Subtype");
    if (type == "Metadata" || has_any(dictionary, {"/Producer", "/Creator"})) return PdfPlace::kMetadata;
    if (type == "Filespec" || type == "F" || type == "EmbeddedFile" || has_any(dictionary, {"/EF"}))
        return PdfPlace::kAttachment;
    if (type == "OCG") return PdfPlace::kLayer;
    if (subtype == "Image") return PdfPlace::kImage;
    if (has_any(dictionary, {"/FT", "/TU"}) || subtype == "Widget") return PdfPlace::kForm;
    if (subtype == "Link") return PdfPlace::kLink;
    if (type == "Annot" || (has_any(dictionary, {"/Rect"}) && !subtype.empty())) return PdfPlace::kAnnotation;
    const std::string action = text_of(dictionary, "/S");
    if (type == "Action" || action == "URI" || action == "Launch" || action == "GoToR" || action == "JavaScript")
        return PdfPlace::kLink;
    if (has_any(dictionary, {"/Title"}) && has_any(dictionary, {"/Parent", "/Dest", "/A", "/Next", "/Prev"}))
        return PdfPlace::kBookmark;
    return otherwise;
}

/// What an entry is whatever the dictionary around it.
PdfPlace place_of_entry(const std::string& key, PdfPlace around) {
    static const std::map<std::string, PdfPlace> places = {{"/PTEX.FileName", PdfPlace::kFigureFile},
                                                           {"/PTEX.InfoDict", PdfPlace::kMetadata},
                                                           {"/URI", PdfPlace::kLink},
                                                           {"/A", PdfPlace::kLink},
                                                           {"/AA", PdfPlace::kLink},
                                                           {"/OpenAction", PdfPlace::kLink},
                                                           {"/EmbeddedFiles", PdfPlace::kAttachment},
                                                           {"/AF", PdfPlace::kAttachment},
                                                           {"/Metadata", PdfPlace::kMetadata},
                                                           {"/PieceInfo", PdfPlace::kMetadata}};
    const auto found = places.find(key);
    return found == places.end() ? around : found->second;
}

/// Names of fonts are those of their designers.
bool is_of_font(const std::string& key) {
    static const std::set<std::string> keys = {"/BaseFont", "/FontName",    "/FontFamily", "/CharSet",
                                               "/Ordering", "/Differences", "/Registry",   "/CIDSystemInfo"};
    return keys.contains(key);
}

/// "g31", "glyph31": numbers that stand for letters; those of dingbats are "a31".
bool is_numbered_glyph(const std::string& name) {
    const std::size_t digits = name.find_first_of("0123456789");
    return digits != std::string::npos && name.find_first_not_of("0123456789", digits) == std::string::npos &&
           name.substr(0, digits) != "a" && !is_known_glyph(name);
}

class Places {
  public:
    Places(QPDF& pdf, const std::string& file, std::uint64_t most, const KnownFonts& known, const PlaceVisitor& visit,
           const NestedVisitor& nested)
        : file_(file), most_(most), drawn_(known), visit_(visit), nested_(nested) {
        int number = 0;
        for (const Object& page : pdf.getAllPages()) mark(page, ++number, 0);
        all_ = pdf.getAllObjects();
        for (const Object& object : all_) note_kinds(object, 0);
    }

    void visit_all() {
        for (const Object& object : all_) {
            page_ = page_of(object);
            if (Object(object).isStream())
                visit_stream(object);
            else
                walk(object, PdfPlace::kInside, "", 0);
        }
        page_ = 0;
        visit_outside();
    }

    /// A sentence when something was too much to be looked at.
    const Message& trouble() const { return trouble_; }

  private:
    using Ids = std::set<QPDFObjGen>;

    static Object dictionary_in(Object object) { return object.isStream() ? object.getDict() : object; }
    int page_of(const Object& object) const {
        const auto found = pages_.find(object.getObjGen());
        return found == pages_.end() ? 0 : found->second;
    }

    /// What a page refers to belongs to it, the first page first.
    void mark(Object value, int page, int depth) {
        if (depth > kDeepestPlace) return;
        if (value.isIndirect() && !pages_.emplace(value.getObjGen(), page).second) return;
        if (value.isArray())
            for (const Object& entry : value.getArrayAsVector()) mark(entry, page, depth + 1);
        value = dictionary_in(value);
        if (!value.isDictionary()) return;
        static const std::set<std::string> elsewhere = {"/Parent", "/P", "/Dest", "/D", "/Popup", "/IRT"};
        for (const auto& [key, entry] : value.getDictAsMap())
            if (!elsewhere.contains(key)) mark(entry, page, depth + 1);
    }

    /// Streams whose kind only the dictionary says that refers to them.
    void note_kinds(Object value, int depth) {
        if (depth > kDeepestPlace || (depth > 0 && value.isIndirect())) return;
        if (value.isArray())
            for (const Object& entry : value.getArrayAsVector()) note_kinds(entry, depth + 1);
        value = dictionary_in(value);
        if (!value.isDictionary()) return;
        if (text_of(value, "/Type") == "Font" || has_any(value, {"/DescendantFonts", "/CharProcs"})) {
            note_font(value);
            note_drawn_letters(value);
            note_simple_letters(value);
        }
        for (auto& [key, entry] : value.getDictAsMap()) {
            if (key.starts_with("/FontFile")) fonts_.insert(entry.getObjGen());
            if (key == "/EF" && entry.isDictionary())
                for (const auto& [name, file] : entry.getDictAsMap()) attachments_.insert(file.getObjGen());
            if (key == "/ToUnicode" && entry.isStream() && known_maps_.insert(entry.getObjGen()).second)
                note_map(code_map(content_of(entry)));
            if (key == "/Differences" && entry.isArray()) note_differences(entry);
            note_kinds(entry, depth + 1);
        }
    }

    /// Codes of letters that are not those of ASCII, as programs number the letters of a subset.
    void note_differences(Object differences) {
        std::vector<std::pair<std::uint32_t, std::string>> glyphs;
        std::uint32_t code = 0;
        for (const Object& entry : differences.getArrayAsVector()) {
            if (Object(entry).isInteger()) code = static_cast<std::uint32_t>(Object(entry).getIntValueAsInt());
            if (Object(entry).isName()) glyphs.emplace_back(code++, Object(entry).getName().substr(1));
        }
        if (const CodeMap map = code_map_of_glyphs(glyphs); !map.text.empty()) note_map(map);
    }

    /// What a font of two-byte codes is made of (ISO 32000-1, 9.7.4).
    static Object descendant_of(Object font) {
        const Object inner = font.getKey("/DescendantFonts");
        const bool has_one = Object(inner).isArray() && Object(inner).getArrayNItems() > 0;
        return has_one ? Object(inner).getArrayItem(0) : inner;
    }

    /// Bytes of a code, where the codes of a font are the numbers of its letters; else 0.
    std::size_t bytes_of_code(Object encoding) {
        if (encoding.isName()) return encoding.getName().starts_with("/Identity") ? 2 : 0;
        const bool is_alone = encoding.isStream() && !encoding.getDict().hasKey("/UseCMap");
        return is_alone ? bytes_of_identity(content_of(encoding)) : 0;
    }

    /// What such a font's table tells of its letters need not be what a reader sees.
    void note_drawn_letters(Object font) {
        if (!font.hasKey("/DescendantFonts")) return;
        Object inner = descendant_of(font);
        Object description = inner.isDictionary() ? inner.getKey("/FontDescriptor") : inner;
        if (!description.isDictionary()) return;
        const Object table = font.getKey("/ToUnicode"), order = inner.getKey("/CIDToGIDMap");
        const CodeMap told = Object(table).isStream() ? code_map(content_of(table)) : CodeMap();
        GlyphCodes codes;
        codes.bytes = bytes_of_code(font.getKey("/Encoding"));
        if (Object(order).isStream()) {
            const std::string bytes = content_of(order);
            for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
                codes.glyphs.push_back(static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[i]) << 8 |
                                                                  static_cast<unsigned char>(bytes[i + 1])));
        }
        for (const char* key : {"/FontFile", "/FontFile2", "/FontFile3"}) {
            const Object file = description.getKey(key);
            if (!Object(file).isStream()) continue;
            if (codes.bytes == 0) {
                trouble_ = Message("It has a font whose codes are not the numbers of its letters.");
                return;
            }
            for (CodeMap& map : drawn_.read(content_of(file), codes, told)) note_map(std::move(map));
        }
    }

    static bool is_descendant(Object font) { return text_of(font, "/Subtype").starts_with("CIDFont"); }
    static Object font_file_of(Object font) {
        Object description = font.getKey("/FontDescriptor");
        return description.isDictionary() ? description.getKey("/FontFile2") : description;
    }
    static Object differences_of(Object font) {
        Object encoding = font.getKey("/Encoding");
        return encoding.isDictionary() ? encoding.getKey("/Differences") : Object::newNull();
    }
    /// Whether most of the letters that a simple font names have numbers for names.
    static bool numbers_its_letters(Object font) {
        int most = 0;
        const Object differences = differences_of(font);
        for (int i = 0; Object(differences).isArray() && i < Object(differences).getArrayNItems(); ++i)
            if (const Object name = Object(differences).getArrayItem(i); Object(name).isName())
                most += is_numbered_glyph(Object(name).getName().substr(1)) ? 1 : -1;
        return most > 0;
    }

    /// The same of a simple TrueType font, whose codes lead through a table of its file where no names of letters do.
    void note_simple_letters(Object font) {
        const Object file = font_file_of(font), table = font.getKey("/ToUnicode");
        if (font.hasKey("/DescendantFonts") || is_descendant(font) || !Object(file).isStream()) return;
        if (Object(differences_of(font)).isArray() && !numbers_its_letters(font)) return;
        CodeMap told = Object(table).isStream() ? code_map(content_of(table)) : CodeMap();
        for (std::uint32_t code = ' '; !font.hasKey("/ToUnicode") && font.hasKey("/Encoding") && code < 127; ++code)
            told.text[code] = static_cast<char>(code);
        for (CodeMap& map : drawn_.read(content_of(file), {1, {}, true}, told)) note_map(std::move(map));
    }

    /// A font whose codes no table explains shows what nobody can read but on paper.
    void note_font(Object font) {
        const std::string kind = text_of(font, "/Subtype");
        if (font.hasKey("/ToUnicode") || is_descendant(font)) return;
        bool readable = false;
        if (kind == "Type0" || font.hasKey("/DescendantFonts")) {
            const Object first = descendant_of(font);
            const Object system = Object(first).isDictionary() ? Object(first).getKey("/CIDSystemInfo") : first;
            const std::string script = Object(system).isDictionary() ? text_of(system, "/Ordering") : "";
            const bool is_known = font.getKey("/Encoding").isName() && bytes_of_code(font.getKey("/Encoding")) == 0;
            readable = is_known || (!script.empty() && script != "Identity");
        } else if (kind == "Type3") {
            const Object encoding = font.getKey("/Encoding");
            const Object names = Object(encoding).isDictionary() ? differences_of(font) : encoding;
            readable = !Object(names).isArray();
            for (int i = 0; !readable && i < Object(names).getArrayNItems(); ++i)
                readable = is_known_glyph(unicode_of(Object(names).getArrayItem(i)));
        } else {
            const bool is_own = !font.hasKey("/Encoding") && Object(font_file_of(font)).isStream();
            readable = !is_own && !numbers_its_letters(font);
        }
        if (!readable) trouble_ = Message("It has text in a font that does not tell which letters it shows.");
    }

    /// Each map once: figures that were made alike bring the same one.
    void note_map(CodeMap map) {
        if (std::find(maps_.begin(), maps_.end(), map) != maps_.end()) return;
        if (maps_.size() < kMostMaps)
            maps_.push_back(std::move(map));
        else
            trouble_ = Message("More than {} of its fonts have codes of their own.", kMostMaps);
    }

    std::string content_of(const Object& stream) {
        try {
            return stream_content(stream, most_).bytes;
        } catch (const PdfRefusal& refusal) {
            trouble_ = refusal.message();
            return {};
        }
    }

    void say(PdfPlace place, const std::string& detail, std::string text, TextManner manner = TextManner::kData) {
        if (!text.empty()) visit_({place, page_, detail, std::move(text), manner});
    }

    void walk(Object value, PdfPlace place, const std::string& key, int depth) {
        if (depth > kDeepestPlace) return;
        if (value.isString() || value.isName()) {
            say(place, key.empty() ? "" : key.substr(1), unicode_of(value),
                is_of_font(key) ? TextManner::kBytes : TextManner::kData);
        } else if (depth > 0 && value.isIndirect()) {
            return;  // It is visited by itself.
        } else if (value.isArray()) {
            for (const Object& entry : value.getArrayAsVector()) walk(entry, place, key, depth + 1);
        } else if (value.isDictionary()) {
            const PdfPlace here = place_in_pdf(value, place);
            for (const auto& [name, entry] : value.getDictAsMap()) {
                say(here, "", name.substr(1));
                walk(entry, place_of_entry(name, here), name, depth + 1);
            }
        }
    }

    void visit_stream(Object stream) {
        const Object entries = stream.getDict();
        walk(entries, PdfPlace::kInside, "", 0);
        const std::string type = text_of(entries, "/Type");
        const bool attached = attachments_.contains(stream.getObjGen());
        const PdfPlace place = attached ? PdfPlace::kAttachment : place_in_pdf(entries, PdfPlace::kInside);
        const std::string data = content_of(stream);
        seen_.insert(std::hash<std::string>()(data));
        if (type == "XRef") return;
        if (place == PdfPlace::kImage) return visit_image(entries, data);
        if (place == PdfPlace::kAttachment) return visit_attachment(data);
        if (type == "Metadata" || data.find("<x:xmpmeta") != std::string::npos)
            return say(PdfPlace::kMetadata, "XMP", without_references(text_in(data)));
        if (fonts_.contains(stream.getObjGen()))
            return say(PdfPlace::kInside, "font", text_in(data), TextManner::kBytes);
        if (type == "ObjStm") return say(PdfPlace::kRemains, "", text_in(data));
        if (shows_text(data)) return visit_content(data);
        say(PdfPlace::kInside, "", text_in(data), is_text(data) ? TextManner::kData : TextManner::kBytes);
    }

    /// Bytes behind the samples, segments of JBIG2 that draw nothing and the like are in no viewer's sight.
    void visit_image(Object entries, const std::string& data) {
        if (data.starts_with("\xFF\xD8")) {
            const JpegParts parts = parts_of_jpeg(data);
            say(PdfPlace::kImage, "", without_references(parts.words));
            say(PdfPlace::kImage, "", parts.tables, TextManner::kBytes);
            return;
        }
        const std::uint64_t samples = bytes_of_samples(entries);
        if (samples == 0) return say(PdfPlace::kImage, "", text_in(data), TextManner::kBytes);
        const std::string_view shown = std::string_view(data).substr(0, samples), rest = data;
        say(PdfPlace::kImage, "", without_references(text_in(rest.substr(shown.size()))));
        say(PdfPlace::kImage, "", text_in(shown.substr(0, samples_left_)), TextManner::kBytes);
        samples_left_ -= std::min(shown.size(), samples_left_);
    }

    void visit_attachment(const std::string& data) {
        if (data.starts_with("%PDF")) return nested_("", data);
        say(PdfPlace::kAttachment, "", without_references(text_in(data)));
        for (const std::string& text : texts_of_archive(data))
            say(PdfPlace::kAttachment, "", without_references(text_in(text)));
        if (is_text(data)) return;
        for (const std::string& piece : compressed_inside(data)) say(PdfPlace::kAttachment, "", text_in(piece));
    }

    /// What poppler may not have been shown, or not as words: it reads a line of text in four directions only.
    void visit_content(const std::string& data) {
        const PdfPlace place = page_ > 0 ? PdfPlace::kHidden : PdfPlace::kRemains;
        UnshownText unshown;
        const std::vector<ShownPiece> pieces = shown_pieces(data, &unshown);
        say(place, "", unshown.words);
        say(place, "", unshown.pictures, TextManner::kBytes);
        say(place, "", shown_text(pieces), TextManner::kProse);
        const std::vector<ShownPiece> placed = pieces_by_place(data);
        if (!placed.empty()) say(place, "", shown_text(placed), TextManner::kProse);
        for (const CodeMap& map : maps_) {
            say(place, "", shown_text(pieces, &map), TextManner::kProse);
            if (!placed.empty()) say(place, "", shown_text(placed, &map), TextManner::kProse);
        }
    }

    /// Bytes that no object holds: comments between objects, earlier versions, what stands behind the end.
    void visit_outside() {
        std::string outside;
        std::size_t at = 0;
        for (;;) {
            std::size_t begin = file_.find("stream", at);
            if (begin == std::string::npos) break;
            outside.append(file_, at, begin - at);
            outside += '\n';
            begin += 6;
            if (begin < file_.size() && file_[begin] == '\r') ++begin;
            if (begin < file_.size() && file_[begin] == '\n') ++begin;
            const std::size_t end = std::min(file_.find("endstream", begin), file_.size());
            visit_piece(std::string_view(file_).substr(begin, end - begin));
            at = std::min(end + 9, file_.size());
        }
        outside.append(file_, at, std::string::npos);
        say(PdfPlace::kRemains, "", text_in(outside));
    }

    void visit_piece(std::string_view stored) {
        std::string data = inflate(stored, kMostInflated).bytes;
        if (data.empty()) data = std::string(stored);
        if (!seen_.insert(std::hash<std::string>()(data)).second) return;
        if (shows_text(data))
            say(PdfPlace::kRemains, "", shown_text(shown_pieces(data)), TextManner::kProse);
        else
            say(PdfPlace::kRemains, "", without_references(text_in(data)),
                is_text(data) ? TextManner::kData : TextManner::kBytes);
    }

    const std::string& file_;
    const std::uint64_t most_;
    DrawnLetters drawn_;
    const PlaceVisitor& visit_;
    const NestedVisitor& nested_;
    std::vector<Object> all_;
    std::map<QPDFObjGen, int> pages_;
    Ids fonts_, attachments_, known_maps_;
    std::set<std::size_t> seen_;
    std::vector<CodeMap> maps_;
    Message trouble_;
    std::size_t samples_left_ = kMostSamples;
    int page_ = 0;
};

}  // namespace

Message visit_places(QPDF& pdf, const std::string& file, std::uint64_t most, const KnownFonts& known,
                     const PlaceVisitor& visit, const NestedVisitor& nested) {
    Places places(pdf, file, most, known, visit, nested);
    places.visit_all();
    return places.trouble();
}

void show_everything(QPDF& pdf) {
    const Object everywhere = Object::parse("[-20000 -20000 20000 20000]");  // points
    for (Object page : pdf.getAllPages())
        for (const char* box : {"/MediaBox", "/CropBox"}) page.replaceKey(box, everywhere);
    pdf.getRoot().removeKey("/OCProperties");
}

}  // namespace dynlab::inline course
