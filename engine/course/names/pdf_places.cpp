#include "course/names/pdf_places.h"

#include <algorithm>
#include <map>
#include <set>

#include "course/names/byte_text.h"
#include "course/names/content_text.h"
#include "documents/pdf/inflate.h"
#include "documents/pdf/pdf_objects.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

constexpr int kDeepestPlace = 600;  ///< qpdf reads 500 levels
constexpr std::size_t kMostMaps = 40, kMostContent = 4u << 20, kMostInflated = 64u << 20;

std::string unicode_of(const std::string& value) {
    if (value.starts_with("u:")) return value.substr(2);
    if (value.starts_with("b:")) {
        std::string bytes;
        for (std::size_t i = 2; i + 1 < value.size(); i += 2)
            bytes += static_cast<char>(std::strtol(value.substr(i, 2).c_str(), nullptr, 16));
        return text_in(bytes);
    }
    if (value.starts_with("n:/")) return value.substr(3);
    return value.starts_with('/') ? value.substr(1) : "";
}

bool is_reference(const json& value) {
    return value.is_string() && value.get_ref<const std::string&>().ends_with(" R") &&
           std::isdigit(static_cast<unsigned char>(value.get_ref<const std::string&>().front()));
}

std::string text_of(const json& dictionary, const char* key) {
    const auto found = dictionary.find(key);
    return found != dictionary.end() && found->is_string() ? unicode_of(found->get<std::string>()) : "";
}

bool has_any(const json& dictionary, std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return dictionary.contains(key); });
}

/// What kind of thing a dictionary is, by its own entries.
PdfPlace place_of(const json& dictionary, PdfPlace otherwise) {
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

class Places {
  public:
    Places(const json& objects, const std::string& file, const PlaceVisitor& visit, const NestedVisitor& nested)
        : all_(objects.at("qpdf").at(1)), file_(file), visit_(visit), nested_(nested) {
        int number = 0;
        for (const json& page : objects.at("pages")) mark(page.at("object"), ++number, 0);
        for (const auto& [name, object] : all_.items()) {
            note_kinds(object, 0);
            note_map(object);
        }
    }

    void visit_all() {
        for (const auto& [name, object] : all_.items()) {
            page_ = page_of(name);
            if (object.contains("stream"))
                visit_stream(name, object.at("stream"));
            else if (object.contains("value"))
                walk(object.at("value"), PdfPlace::kInside, "", 0);
        }
        page_ = 0;
        visit_outside();
    }

  private:
    const json* object(const std::string& reference) const {
        const auto found = all_.find("obj:" + reference);
        return found == all_.end() ? nullptr : &*found;
    }
    int page_of(const std::string& name) const {
        const auto found = pages_.find(name);
        return found == pages_.end() ? 0 : found->second;
    }

    /// What a page refers to belongs to it, the first page first.
    void mark(const json& value, int page, int depth) {
        if (depth > kDeepestPlace) return;
        if (is_reference(value)) {
            const std::string name = "obj:" + value.get<std::string>();
            const json* const target = object(value.get<std::string>());
            if (target == nullptr || !pages_.emplace(name, page).second) return;
            if (target->contains("value")) mark(target->at("value"), page, depth + 1);
            if (target->contains("stream")) mark(target->at("stream").at("dict"), page, depth + 1);
        } else if (value.is_array()) {
            for (const json& entry : value) mark(entry, page, depth + 1);
        } else if (value.is_object()) {
            static const std::set<std::string> elsewhere = {"/Parent", "/P", "/Dest", "/D", "/Popup", "/IRT"};
            for (const auto& [key, entry] : value.items())
                if (!elsewhere.contains(key)) mark(entry, page, depth + 1);
        }
    }

    /// Streams whose kind only the dictionary says that refers to them.
    void note_kinds(const json& value, int depth) {
        if (depth > kDeepestPlace) return;
        if (value.is_array())
            for (const json& entry : value) note_kinds(entry, depth + 1);
        if (!value.is_object()) return;
        for (const auto& [key, entry] : value.items()) {
            if (key.starts_with("/FontFile") && is_reference(entry)) fonts_.insert("obj:" + entry.get<std::string>());
            if (key == "/EF" && entry.is_object())
                for (const json& file : entry)
                    if (is_reference(file)) attachments_.insert("obj:" + file.get<std::string>());
            note_kinds(entry, depth + 1);
        }
    }

    void note_map(const json& object) {
        const json& value = object.contains("value") ? object.at("value") : object;
        if (!value.is_object()) return;
        if (!value.contains("/ToUnicode") || !is_reference(value.at("/ToUnicode")) || maps_.size() >= kMostMaps) return;
        const json* const map = this->object(value.at("/ToUnicode").get<std::string>());
        if (map && map->contains("stream")) maps_.push_back(code_map(data_of(map->at("stream"))));
    }

    static std::string data_of(const json& stream) {
        const auto data = stream.find("data");
        return data == stream.end() ? "" : bytes_of_base64(data->get_ref<const std::string&>());
    }

    void say(PdfPlace place, const std::string& detail, std::string text, TextManner manner = TextManner::kData) {
        if (!text.empty()) visit_({place, page_, detail, std::move(text), manner});
    }

    void walk(const json& value, PdfPlace place, const std::string& key, int depth) {
        if (depth > kDeepestPlace) return;
        if (value.is_string()) {
            if (is_reference(value)) return walk_string_at(value.get<std::string>(), place, key, depth);
            say(place, key.empty() ? "" : key.substr(1), unicode_of(value.get<std::string>()),
                is_of_font(key) ? TextManner::kBytes : TextManner::kData);
        } else if (value.is_array()) {
            for (const json& entry : value) walk(entry, place, key, depth + 1);
        } else if (value.is_object()) {
            const PdfPlace here = place_of(value, place);
            for (const auto& [name, entry] : value.items()) {
                say(here, "", unicode_of(name));
                walk(entry, place_of_entry(name, here), name, depth + 1);
            }
        }
    }

    /// A string that stands in an object of its own is what the entry says that refers to it.
    void walk_string_at(const std::string& reference, PdfPlace place, const std::string& key, int depth) {
        const json* const target = object(reference);
        if (target == nullptr || !target->contains("value")) return;
        const json& value = target->at("value");
        if (value.is_string() && !is_reference(value)) walk(value, place, key, depth + 1);
    }

    void visit_stream(const std::string& name, const json& stream) {
        const json& dict = stream.at("dict");
        walk(dict, PdfPlace::kInside, "", 0);
        const std::string type = text_of(dict, "/Type");
        const PdfPlace place = attachments_.contains(name) ? PdfPlace::kAttachment : place_of(dict, PdfPlace::kInside);
        const std::string data = data_of(stream);
        seen_.insert(std::hash<std::string>()(data));
        if (type == "XRef") return;
        if (place == PdfPlace::kImage) return visit_image(dict, data);
        if (place == PdfPlace::kAttachment) return visit_attachment(data);
        if (type == "Metadata" || data.find("<x:xmpmeta") != std::string::npos)
            return say(PdfPlace::kMetadata, "XMP", without_references(text_in(data)));
        if (fonts_.contains(name)) return say(PdfPlace::kInside, "font", text_in(data), TextManner::kBytes);
        if (type == "ObjStm") return say(PdfPlace::kRemains, "", text_in(data));
        if (data.size() <= kMostContent && shows_text(data)) return visit_content(name, data);
        say(PdfPlace::kInside, "", text_in(data), TextManner::kBytes);
    }

    void visit_image(const json& dict, const std::string& data) {
        const std::string filter = dict.contains("/Filter") ? dict.at("/Filter").dump() : "";
        if (data.starts_with("\xFF\xD8"))
            say(PdfPlace::kImage, "", without_references(metadata_of_jpeg(data)));
        else if (filter.find("JPX") != std::string::npos)
            say(PdfPlace::kImage, "", text_in(data), TextManner::kBytes);
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
    void visit_content(const std::string& name, const std::string& data) {
        const PdfPlace place = page_of(name) > 0 ? PdfPlace::kHidden : PdfPlace::kRemains;
        const std::vector<ShownPiece> pieces = shown_pieces(data);
        say(place, "", shown_text(pieces), TextManner::kProse);
        for (const CodeMap& map : maps_) say(place, "", shown_text(pieces, &map), TextManner::kProse);
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
        if (data.size() <= kMostContent && shows_text(data))
            say(PdfPlace::kRemains, "", shown_text(shown_pieces(data)), TextManner::kProse);
        else
            say(PdfPlace::kRemains, "", without_references(text_in(data)),
                is_text(data) ? TextManner::kData : TextManner::kBytes);
    }

    const json& all_;
    const std::string& file_;
    const PlaceVisitor& visit_;
    const NestedVisitor& nested_;
    std::map<std::string, int> pages_;
    std::set<std::string> fonts_, attachments_;
    std::set<std::size_t> seen_;
    std::vector<CodeMap> maps_;
    int page_ = 0;
};

}  // namespace

void visit_places(const json& objects, const std::string& file, const PlaceVisitor& visit,
                  const NestedVisitor& nested) {
    Places(objects, file, visit, nested).visit_all();
}

json with_everything_shown(const json& objects) {
    static constexpr int kFar = 20000;  // points
    const json& all = objects.at("qpdf").at(1);
    json changed = json::object();
    const auto change = [&](const std::string& name, const auto& how) {
        if (!all.contains(name) || !all.at(name).contains("value")) return;
        json value = all.at(name).at("value");
        how(value);
        changed[name] = {{"value", std::move(value)}};
    };
    for (const json& page : objects.at("pages")) {
        change("obj:" + page.at("object").get<std::string>(), [](json& value) {
            value["/MediaBox"] = json::array({-kFar, -kFar, kFar, kFar});
            value["/CropBox"] = value["/MediaBox"];
        });
    }
    const json& trailer = all.at("trailer").at("value");
    if (is_reference(trailer.value("/Root", json())))
        change("obj:" + trailer.at("/Root").get<std::string>(), [](json& value) { value.erase("/OCProperties"); });
    const json head = {{"jsonversion", 2}, {"pdfversion", "1.7"}};
    return {{"qpdf", json::array({head, std::move(changed)})}};
}

}  // namespace dynlab::inline course
