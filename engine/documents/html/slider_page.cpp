#include "documents/html/slider_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "documents/chunks/chunk_setter.h"
#include "documents/html/web_page.h"
#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

using nlohmann::json;

constexpr std::size_t kPlacesWithoutSteps = 21, kMostPlaces = 25;

/// Steps are added up without their last digits; places between them are round numbers.
double with_digits(double value, int digits) {
    return std::stod(fmt::format("{:.{}g}", value, digits));
}

/// The chunks of a document as they stand in the page; where `drawn`, pictures with what a printer needs.
std::vector<std::string> pieces_at(ChunkSetter& setter, const DocumentSource& source, bool drawn,
                                   std::vector<SetChunk>* chunks = nullptr) {
    SetDocument document = setter.set(source, false);
    std::vector<std::string> pieces;
    for (const SetChunk& chunk : document.chunks) {
        std::vector<PlacedPicture> pictures;
        for (const SetPicture& picture : chunk.pictures) {
            const auto figure = source.record->figures.find(picture.name);
            if (!picture.is_figure)
                pictures.push_back({picture.file, picture.written_name, {}});
            else if (figure != source.record->figures.end())
                pictures.push_back({drawn ? figure->second.file : "", picture.written_name, figure->second.plot});
        }
        pieces.push_back(with_inlined_pictures(chunk.html, pictures));
    }
    if (!document.notes.empty()) pieces.push_back(document.notes);
    if (chunks) *chunks = std::move(document.chunks);
    return pieces;
}

/// Where the controls of a cell stand: behind this chunk, the cell's last or the last of what comes before it.
std::size_t chunk_before_control(const std::vector<SetChunk>& chunks, const PercentScript& script,
                                 const std::string& cell) {
    int last_line = 0;
    for (const Cell& one : script.cells)
        if (one.id == cell) last_line = one.last_line();
    std::size_t found = 0;
    for (std::size_t i = 0; i < chunks.size(); ++i)
        if (chunks[i].chunk.origin.file == script.file && chunks[i].chunk.origin.line <= last_line) found = i;
    return found;
}

/// Title page and list of contents, which stand before the first chunk.
std::string before_chunks(std::string main) {
    std::string kept;
    for (const auto& [opens, closes] :
         {std::pair<std::string, std::string>{"<div class=\"abstract\">", "</div>\n"}, {"<nav>", "</nav>\n"}}) {
        const std::size_t end = main.find(closes);
        if (!main.starts_with(opens) || end == std::string::npos) continue;
        kept += main.substr(0, end + closes.size());
        main.erase(0, end + closes.size());
    }
    return kept;
}

std::string as_one(const std::vector<std::string>& pieces) {
    std::string html;
    for (const std::string& piece : pieces) html += piece + "\n";
    return html;
}

}  // namespace

std::vector<double> places_of(const RecordedSlider& slider) {
    std::vector<double> values;
    const double steps = slider.step ? std::floor((slider.to - slider.from) / *slider.step + 1e-9) : 0;
    const auto count = slider.step ? std::min<double>(steps + 1, kMostPlaces) : double{kPlacesWithoutSteps};
    for (double i = 0; i < count; ++i) {
        const double part = count > 1 ? i / (count - 1) : 0;
        if (slider.step)
            values.push_back(with_digits(slider.from + *slider.step * std::round(part * steps), 12));
        else if (slider.logarithmic)
            values.push_back(with_digits(slider.from * std::pow(slider.to / slider.from, part), 4));
        else
            values.push_back(with_digits(slider.from + (slider.to - slider.from) * part, 4));
    }
    for (double& value : values) value = std::clamp(value, slider.from, slider.to);
    values.push_back(slider.value);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::string page_with_sliders(const std::string& page, const PercentScript& script,
                              const std::vector<SliderPlaces>& sliders) {
    const std::string opens = "<main>\n", closes = "</main>";
    const std::size_t begin = page.find(opens), end = page.rfind(closes);
    if (sliders.empty() || begin == std::string::npos || end == std::string::npos) return page;
    ChunkSetter setter;
    std::vector<SetChunk> chunks;
    std::vector<std::string> shown = pieces_at(setter, sliders[0].documents[sliders[0].shown], true, &chunks);
    std::vector<std::vector<std::vector<std::string>>> places(sliders.size());
    bool alike = true;
    for (std::size_t s = 0; s < sliders.size(); ++s)
        for (std::size_t i = 0; i < sliders[s].values.size(); ++i) {
            const bool own = i == sliders[s].shown;
            places[s].push_back(own ? shown : pieces_at(setter, sliders[s].documents[i], false));
            alike = alike && places[s].back().size() == shown.size();
        }
    // Behind which piece the controls stand, and what of the pieces differs from place to place.
    std::map<std::size_t, std::string> controls;
    json list = json::array();
    for (std::size_t s = 0; s < sliders.size(); ++s) {
        const SliderPlaces& slider = sliders[s];
        controls[chunk_before_control(chunks, script, slider.slider.cell)] +=
            fmt::format("<div class=\"slider\" data-number=\"{}\"></div>\n", s);
        json pieces = json::object();
        // At their own place all sliders show the same: its chunks are those that the same setter gives undrawn.
        const std::vector<std::string> same = pieces_at(setter, slider.documents[slider.shown], false);
        for (std::size_t k = 0; k < (alike ? shown.size() : 1); ++k) {
            json html = json::array();
            bool differs = false;
            for (std::size_t i = 0; i < slider.values.size(); ++i) {
                const std::string& there = alike ? places[s][i][k] : as_one(places[s][i]);
                const bool equal = i == slider.shown || there == (alike ? same[k] : as_one(same));
                html.push_back(equal ? json() : json(there));
                differs = differs || !equal;
            }
            if (differs) pieces[std::to_string(k)] = html;
        }
        list.push_back({{"name", slider.name},
                        {"label", slider.slider.label},
                        {"unit", slider.slider.unit},
                        {"values", slider.values},
                        {"shown", slider.shown},
                        {"pieces", pieces}});
    }
    if (!alike) {
        std::string all;
        for (const auto& [chunk, control] : controls) all += control;
        controls = {{0, all}};
        shown = {as_one(shown)};
    }
    std::string main = before_chunks(page.substr(begin + opens.size(), end - begin - opens.size()));
    if (!alike) main += controls[0];
    for (std::size_t k = 0; k < shown.size(); ++k) {
        main += fmt::format("<div class=\"piece\" id=\"piece-{}\">\n{}\n</div>\n", k, shown[k]);
        if (alike && controls.contains(k)) main += controls[k];
    }
    const std::string data = replaced(list.dump(-1, ' ', true, json::error_handler_t::replace), "<", "\\u003c");
    main += "<script type=\"application/json\" class=\"slider-places\">" + data + "</script>\n";
    return page.substr(0, begin + opens.size()) + main + page.substr(end);
}

}  // namespace dynlab::inline documents
