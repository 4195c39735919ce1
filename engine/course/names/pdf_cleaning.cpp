#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>
#include <set>

#include "course/names/anonymous_copy.h"
#include "course/names/jpeg_parts.h"
#include "course/names/picture_samples.h"
#include "course/names/plain_words.h"

namespace dynlab::inline course {
namespace {

using Object = QPDFObjectHandle;

/// Entries of any dictionary that speak of people, programs and dates, not of what is printed.
const std::set<std::string>& private_entries() {
    static const std::set<std::string> entries = {"/Metadata",
                                                  "/PieceInfo",
                                                  "/LastModified",
                                                  "/PTEX.FileName",
                                                  "/PTEX.InfoDict",
                                                  "/PTEX.PageNumber",
                                                  "/Thumb",
                                                  "/EmbeddedFiles",
                                                  "/AF",
                                                  "/AcroForm",
                                                  "/OpenAction",
                                                  "/AA",
                                                  "/PresSteps",
                                                  "/DestOutputProfileRef",
                                                  "/URLS",
                                                  "/Renditions",
                                                  "/SpiderInfo",
                                                  "/PTEX.Fullbanner",
                                                  "/ID",
                                                  "/Perms",
                                                  "/Collection",
                                                  "/JavaScript"};
    return entries;
}

/// Kinds of actions that run or load something, or change what is shown (ISO 32000-2, table 201).
const std::set<std::string>& active_kinds() {
    static const std::set<std::string> kinds = {
        "/GoToR",     "/GoToE",      "/GoToDp",     "/Launch",    "/Thread",          "/Sound",
        "/Movie",     "/Hide",       "/SubmitForm", "/ResetForm", "/ImportData",      "/SetOCGState",
        "/Rendition", "/GoTo3DView", "/JavaScript", "/Trans",     "/RichMediaExecute"};
    return kinds;
}

class PdfCleaner {
  public:
    PdfCleaner(QPDF& pdf, std::uint64_t most) : pdf_(pdf), most_(most) {}

    void clean() {
        Object trailer = pdf_.getTrailer();
        for (const std::string& key : trailer.getKeys())
            if (key != "/Root") trailer.removeKey(key);
        pdf_.getRoot().removeKey("/URI");                    // addresses would be meant relative to its /Base
        trailer.replaceKey("/Size", Object::newInteger(1));  // libqpdf writes its own, but only where there is one
        for (const Object& object : pdf_.getAllObjects()) {
            if (Object(object).isStream())
                clean_stream(object);
            else
                clean(object);
        }
    }

  private:
    /// A value without those that it refers to, which are cleaned by themselves.
    void clean(Object value) {
        if (value.isArray()) {
            for (int i = 0; i < value.getArrayNItems(); ++i) {
                const Object entry = value.getArrayItem(i);
                if (is_active("", entry) || is_fetched(entry))
                    value.setArrayItem(i, Object::newNull());
                else if (!entry.isIndirect())
                    clean(entry);
            }
        }
        if (!value.isDictionary()) return;
        for (const std::string& key : private_entries()) value.removeKey(key);
        if (value.hasKey("/Annots")) value.replaceKey("/Annots", links_of(value.getKey("/Annots")));
        if (name_at(value, "/Subtype") == "/Link") clean_link(value);
        if (is_plain_action(value)) value.removeKey("/Next");
        for (const auto& [key, entry] : value.getDictAsMap()) {
            if (is_active(key, entry) || is_fetched(entry))
                value.removeKey(key);
            else if (!entry.isIndirect())
                clean(entry);
        }
    }

    static void clean_link(Object link) {
        for (const char* key : {"/T", "/Contents", "/NM", "/M", "/CreationDate", "/RC", "/Subj", "/PA"})
            link.removeKey(key);
        if (link.hasKey("/A") && !is_plain_action(link.getKey("/A"))) link.removeKey("/A");
    }

    static std::string name_at(Object dictionary, const char* key) {
        const Object name = dictionary.getKey(key);
        return Object(name).isName() ? Object(name).getName() : "";
    }

    static Object links_of(Object annotations) {
        Object links = Object::newArray();
        if (!annotations.isArray()) return links;
        for (const Object& one : annotations.getArrayAsVector())
            if (Object(one).isDictionaryOfType("", "/Link")) links.appendItem(one);
        return links;
    }

    /// An address of the web or of mail, or one that lies beside the document, not on another machine ("//HOST/a",
    /// "\\HOST\a").
    static bool is_plain_address(const std::string& address) {
        if (address.starts_with("//") || address.find('\\') != std::string::npos) return false;
        const std::string scheme = folded(address.substr(0, address.find_first_of(":/?#")));
        const bool has_scheme = address.size() > scheme.size() && address[scheme.size()] == ':';
        return !has_scheme || scheme == "http" || scheme == "https" || scheme == "mailto";
    }

    /// An action that shows a place in the document or opens an address.
    static bool is_plain_action(Object action) {
        static const std::set<std::string> pages = {"/NextPage", "/PrevPage", "/FirstPage", "/LastPage"};
        if (!action.isDictionary()) return false;
        const std::string kind = name_at(action, "/S");
        if (kind == "/URI") {
            Object address = action.getKey("/URI");
            return address.isString() && is_plain_address(address.getUTF8Value());
        }
        return kind == "/GoTo" || (kind == "/Named" && pages.contains(name_at(action, "/N")));
    }

    /// Whether an entry leads to an action of another kind: of any kind where viewers look for one, else of a known
    /// kind, as roles in the structure and styles of lines have their /S, too.
    static bool is_active(const std::string& key, Object entry) {
        const Object value = entry.isStream() ? entry.getDict() : entry;
        if (!Object(value).isDictionary() || is_plain_action(entry)) return false;
        const std::string kind = name_at(value, "/S");
        if (kind.empty()) return false;
        return key == "/A" || key == "/Next" || kind == "/Named" || kind == "/URI" || active_kinds().contains(kind) ||
               name_at(value, "/Type") == "/Action";
    }

    /// A file that lies elsewhere (ISO 32000-1, 7.11.5).
    static bool is_fetched(Object entry) { return entry.isDictionary() && name_at(entry, "/FS") == "/URL"; }

    void clean_stream(Object stream) {
        Object entries = stream.getDict();
        // Viewers would fetch them from elsewhere.
        for (const char* key : {"/F", "/FFilter", "/FDecodeParms", "/Ref", "/OPI"}) entries.removeKey(key);
        if (stream.isStreamOfType("/Metadata") || stream.isStreamOfType("/EmbeddedFile")) {
            stream.replaceDict(Object::newDictionary());
            stream.replaceStreamData("", Object::newNull(), Object::newNull());
            return;
        }
        clean(entries);
        unpack(stream);
        if (!entries.isDictionaryOfType("", "/Image")) return;
        cut_samples(stream);
        const std::string bytes = stored_bytes(stream);
        if (!bytes.starts_with("\xFF\xD8")) return;
        stream.replaceStreamData(parts_of_jpeg(bytes).picture, entries.getKey("/Filter"),
                                 entries.getKey("/DecodeParms"));
    }

    /// Takes off all packing, behind whose end no viewer looks; libqpdf packs again. The code of a picture stays.
    void unpack(Object stream) {
        Object filter = stream.getDict().getKey("/Filter"), told = stream.getDict().getKey("/DecodeParms");
        if (filter.isNull()) return;
        const StreamContent content = stream_content(stream, most_);
        if (content.decoded) return stream.replaceStreamData(content.bytes, Object::newNull(), Object::newNull());
        if (!filter.isArray() || filter.getArrayNItems() < 2) return;
        std::vector<Object> filters = filter.getArrayAsVector(), settings;
        if (told.isArray()) settings = told.getArrayAsVector();
        settings.resize(filters.size(), Object::newNull());
        const Object code = filters.back(), its_settings = settings.back();
        filters.pop_back();
        settings.pop_back();
        Object packed = Object::newStream(&pdf_, stored_bytes(stream));
        packed.getDict().replaceKey("/Filter", Object::newArray(filters));
        packed.getDict().replaceKey("/DecodeParms", Object::newArray(settings));
        const StreamContent picture = stream_content(packed, most_);
        if (picture.decoded) stream.replaceStreamData(picture.bytes, code, its_settings);
    }

    /// Of samples as they are, or packed without loss, only those that are shown.
    void cut_samples(Object picture) {
        const std::uint64_t shown = bytes_of_samples(picture.getDict());
        if (shown == 0) return;
        StreamContent samples = stream_content(picture, most_);
        if (!samples.decoded || samples.bytes.size() <= shown) return;
        samples.bytes.resize(shown);
        picture.replaceStreamData(samples.bytes, Object::newNull(), Object::newNull());
    }

    QPDF& pdf_;
    const std::uint64_t most_;  ///< bytes of a stream
};

}  // namespace

std::string clean_pdf(const std::filesystem::path& file, const PdfObjectLimits& limits) {
    return work_on_pdf_objects(file, limits, [&](QPDF& pdf, const std::string&) {
        PdfCleaner(pdf, limits.bytes_inside).clean();
        return written_pdf(pdf, limits.bytes_inside,
                           [](QPDFWriter& writer) { writer.setObjectStreamMode(qpdf_o_generate); });
    });
}

}  // namespace dynlab::inline course
