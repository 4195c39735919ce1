#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "course/names/anonymous_copy.h"
#include "platform/guarded_call.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

constexpr int kDeepestObject = 600;  ///< qpdf reads 500 levels
constexpr std::uint64_t kGuardMemory = 6ull << 30;

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
                                                  "/URI_Base",
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

class Cleaning {
  public:
    explicit Cleaning(const std::string& text) : document_(json::parse(text)), all_(document_.at("qpdf").at(1)) {}

    std::string cleaned() {
        json& trailer = all_.at("trailer").at("value");
        const json root = trailer.value("/Root", json());
        trailer =
            json::object({{"/Root", root}, {"/Size", 1}});  // qpdf writes the size itself, but only where there is one
        for (auto& [name, object] : all_.items()) {
            if (object.contains("stream"))
                clean_stream(object.at("stream"));
            else if (object.contains("value"))
                clean(object.at("value"), 0);
        }
        document_.erase("pages");
        return document_.dump();
    }

  private:
    void clean(json& value, int depth) {
        if (depth > kDeepestObject) value = nullptr;
        if (value.is_array()) {
            for (json& entry : value) {
                if (is_active("", entry)) entry = nullptr;
                clean(entry, depth + 1);
            }
            return;
        }
        if (!value.is_object()) return;
        for (const std::string& key : private_entries()) value.erase(key);
        if (value.contains("/Annots")) keep_links(value.at("/Annots"));
        if (name_at(value, "/Subtype") == "/Link") clean_link(value);
        if (is_plain_action(value)) value.erase("/Next");
        for (auto entry = value.begin(); entry != value.end();) {
            const bool active = is_active(entry.key(), entry.value());
            if (!active) clean(entry.value(), depth + 1);
            entry = active ? value.erase(entry) : std::next(entry);
        }
    }

    void clean_link(json& link) const {
        for (const char* key : {"/T", "/Contents", "/NM", "/M", "/CreationDate", "/RC", "/Subj", "/PA"})
            link.erase(key);
        if (link.contains("/A") && !is_plain_action(link.at("/A"))) link.erase("/A");
    }

    /// What stands in the object that a reference leads to, at last; null for none.
    const json* object_at(const json& value) const {
        const json* object = nullptr;
        const json* reference = &value;
        for (int i = 0; i < kDeepestObject && reference->is_string(); ++i) {
            const auto found = all_.find("obj:" + reference->get<std::string>());
            if (found == all_.end()) break;
            object = &*found;
            if (!object->contains("value")) break;
            reference = &object->at("value");
        }
        return object;
    }

    /// The value itself or the one that a reference leads to.
    const json& resolved(const json& value) const {
        const json* const object = object_at(value);
        return object && object->contains("value") ? object->at("value") : value;
    }

    std::string name_at(const json& dictionary, const char* key) const {
        const auto found = dictionary.find(key);
        if (found == dictionary.end()) return "";
        const json& name = resolved(*found);
        return name.is_string() ? name.get<std::string>() : "";
    }

    void keep_links(json& annotations) const {
        json kept = json::array();
        const json& list = resolved(annotations);
        if (list.is_array()) {
            for (const json& one : list) {
                const json& annotation = resolved(one);
                if (annotation.is_object() && name_at(annotation, "/Subtype") == "/Link") kept.push_back(one);
            }
        }
        annotations = std::move(kept);
    }

    /// An action that shows a place in the document or opens an address.
    bool is_plain_action(const json& action) const {
        static const std::set<std::string> pages = {"/NextPage", "/PrevPage", "/FirstPage", "/LastPage"};
        const json& value = resolved(action);
        if (!value.is_object()) return false;
        const std::string kind = name_at(value, "/S");
        return kind == "/GoTo" || kind == "/URI" || (kind == "/Named" && pages.contains(name_at(value, "/N")));
    }

    /// Whether an entry leads to an action of another kind: of any kind where viewers look for one, else of a known
    /// kind, as roles in the structure and styles of lines have their /S, too.
    bool is_active(const std::string& key, const json& entry) const {
        const json* const object = object_at(entry);
        const json& value = object && object->contains("stream") ? object->at("stream").at("dict") : resolved(entry);
        if (!value.is_object() || is_plain_action(value)) return false;
        const std::string kind = name_at(value, "/S");
        if (kind.empty()) return false;
        return key == "/A" || key == "/Next" || kind == "/Named" || active_kinds().contains(kind) ||
               name_at(value, "/Type") == "/Action";
    }

    static void clean_jpeg(std::string& bytes) {
        std::string result = bytes.substr(0, 2);
        std::size_t at = 2;
        const auto byte = [&bytes](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
        while (at + 4 <= bytes.size() && byte(at) == 0xFF && byte(at + 1) != 0xDA) {
            const unsigned char marker = byte(at + 1);
            const std::size_t length = 2 + (static_cast<std::size_t>(byte(at + 2)) << 8 | byte(at + 3));
            const std::string segment = bytes.substr(at, length);
            // APP0 (JFIF), APP2 (colour profile) and APP14 (colour transform) say how the picture is shown.
            const bool speaks =
                marker == 0xFE || (marker >= 0xE1 && marker <= 0xEF && marker != 0xEE &&
                                   !(marker == 0xE2 && segment.find("ICC_PROFILE") != std::string::npos));
            if (!speaks) result += segment;
            at += length;
        }
        if (at >= bytes.size()) return;
        const std::size_t end = bytes.rfind("\xFF\xD9");
        result += bytes.substr(at, end == std::string::npos || end < at ? std::string::npos : end + 2 - at);
        bytes = std::move(result);
    }

    void clean_stream(json& stream) {
        json& dict = stream.at("dict");
        const std::string type = name_at(dict, "/Type");
        // Viewers would fetch them from elsewhere.
        for (const char* key : {"/F", "/FFilter", "/FDecodeParms", "/Ref", "/OPI"}) dict.erase(key);
        clean(dict, 0);
        if (type == "/Metadata" || type == "/EmbeddedFile") stream["data"] = "";
        if (type == "/Metadata" || type == "/EmbeddedFile") dict = json::object();
        if (name_at(dict, "/Subtype") != "/Image" || !stream.contains("data")) return;
        std::string bytes = bytes_of_base64(stream.at("data").get_ref<const std::string&>());
        if (!bytes.starts_with("\xFF\xD8")) return;
        clean_jpeg(bytes);
        stream["data"] = base64_of(bytes);
    }

    json document_;
    json& all_;
};

}  // namespace

std::string clean_pdf(const std::filesystem::path& file, const PdfObjectLimits& limits) {
    const std::string objects = pdf_objects(file, StreamForm::kAsStored, limits);
    const ChildResult cleaned =
        run_guarded([&] { return Cleaning(objects).cleaned(); }, {limits.time, kGuardMemory, 2 * limits.output_bytes});
    if (cleaned.exit_code != 0 || cleaned.timed_out || cleaned.output_exceeded)
        throw PdfRefusal(PdfFault::kTooLarge, "Cleaning the file takes too long or too much memory.");
    return pdf_with_objects({}, cleaned.output, limits);
}

}  // namespace dynlab::inline course
