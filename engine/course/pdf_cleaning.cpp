#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "course/anonymous_copy.h"
#include "platform/guarded_call.h"

namespace dynlab {
namespace {

using nlohmann::json;

constexpr int kDeepest = 200;
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
                                                  "/URI_Base",
                                                  "/SpiderInfo",
                                                  "/PTEX.Fullbanner",
                                                  "/ID",
                                                  "/Perms",
                                                  "/Collection",
                                                  "/JavaScript"};
    return entries;
}

std::string name_in(const json& dictionary, const char* key) {
    const auto found = dictionary.find(key);
    return found != dictionary.end() && found->is_string() ? found->get<std::string>() : "";
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
        if (depth > kDeepest) return;
        if (value.is_array()) {
            for (json& entry : value) clean(entry, depth + 1);
            return;
        }
        if (!value.is_object()) return;
        for (const std::string& key : private_entries()) value.erase(key);
        if (value.contains("/Annots")) keep_links(value.at("/Annots"));
        if (name_in(value, "/Subtype") == "/Link") {
            for (const char* key : {"/T", "/Contents", "/NM", "/M", "/CreationDate", "/RC", "/Subj"}) value.erase(key);
            if (value.contains("/A") && !is_plain_action(value.at("/A"))) value.erase("/A");
        }
        for (auto& [key, entry] : value.items()) clean(entry, depth + 1);
    }

    /// The value a reference leads to, once.
    const json& resolved(const json& value) const {
        if (!value.is_string()) return value;
        const auto found = all_.find("obj:" + value.get<std::string>());
        return found != all_.end() && found->contains("value") ? found->at("value") : value;
    }

    void keep_links(json& annotations) const {
        json kept = json::array();
        const json& list = resolved(annotations);
        if (list.is_array()) {
            for (const json& one : list) {
                const json& annotation = resolved(one);
                if (annotation.is_object() && name_in(annotation, "/Subtype") == "/Link") kept.push_back(one);
            }
        }
        annotations = std::move(kept);
    }

    bool is_plain_action(const json& action) const {
        const json& value = resolved(action);
        if (!value.is_object()) return false;
        const std::string kind = name_in(value, "/S");
        return kind == "/GoTo" || kind == "/URI" || kind == "/Named";
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
        const std::string type = name_in(dict, "/Type");
        clean(dict, 0);
        if (type == "/Metadata" || type == "/EmbeddedFile") stream["data"] = "";
        if (type == "/Metadata" || type == "/EmbeddedFile") dict = json::object();
        if (name_in(dict, "/Subtype") != "/Image" || !stream.contains("data")) return;
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

}  // namespace dynlab
