#include "documents/html/slider_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "documents/chunks/chunk_setter.h"
#include "documents/html/web_page.h"
#include "documents/text_lines.h"

namespace dynlab::inline documents {

/// A chunk of the page, with the data of its figures kept separately.
struct SliderPiece {
    std::string html;
    std::vector<std::string> figures, plots;  ///< their names, and what documents/html/plot_data.h says of each
    std::string with_plots;                   ///< the whole of it
};

namespace {

using nlohmann::json;

constexpr std::size_t kPlacesWithoutSteps = 21, kMaxCombinations = 450;

/// Steps are added up without their last digits; places between them are round numbers.
double with_digits(double value, int digits) {
    return std::stod(fmt::format("{:.{}g}", value, digits));
}

/// The chunks of a document; where `drawn`, pictures with what a printer needs.
std::vector<SliderPiece> placed_pieces(const SetDocument& document, const RunRecord& record, bool drawn) {
    std::vector<SliderPiece> pieces;
    for (const SetChunk& chunk : document.chunks) {
        SliderPiece piece;
        std::vector<PlacedPicture> pictures;
        for (const SetPicture& picture : chunk.pictures) {
            const auto figure = record.figures.find(picture.name);
            if (!picture.is_figure)
                pictures.push_back({picture.file, picture.written_name, {}});
            else if (figure != record.figures.end()) {
                pictures.push_back({drawn ? figure->second.file : "", picture.written_name, figure->second.plot});
                if (figure->second.plot.empty()) continue;
                piece.figures.push_back(picture.name);
                piece.plots.push_back(figure->second.plot);
            }
        }
        piece.with_plots = with_inlined_pictures(chunk.html, pictures);
        for (PlacedPicture& picture : pictures) picture.plot.clear();
        piece.html = with_inlined_pictures(chunk.html, pictures);
        pieces.push_back(std::move(piece));
    }
    if (!document.notes.empty()) pieces.push_back({document.notes, {}, {}, document.notes});
    return pieces;
}

/// The part of `to` that differs from `from`. For objects, and for lists of equal length of objects or lists: the
/// members that differ, by their names or places. For anything else: the whole value, in a one-element list.
json difference(const json& from, const json& to) {
    const auto keyed = [](const json& value) {
        return value.is_object() || (value.is_array() && !value.empty() && value[0].is_structured());
    };
    if (!keyed(from) || from.type() != to.type() || from.size() != to.size()) return json::array({to});
    json members = json::object();
    for (const auto& [key, value] : from.items()) {
        if (to.is_object() && !to.contains(key)) return json::array({to});
        const json& there = to.is_object() ? to[key] : to[std::stoul(key)];
        if (there != value) members[key] = difference(value, there);
    }
    return members;
}

/// What a page keeps of a piece elsewhere: null where it is the same, its HTML where that is another, else for each of
/// its figures what is drawn otherwise.
json kept_of(const SliderPiece& own, const SliderPiece& there) {
    if (own.html != there.html || own.plots.size() != there.plots.size()) return there.with_plots;
    if (own.plots == there.plots) return {};
    json figures = json::array();
    for (std::size_t i = 0; i < own.plots.size(); ++i)
        figures.push_back(own.plots[i] == there.plots[i]
                              ? json()
                              : difference(json::parse(own.plots[i]), json::parse(there.plots[i])));
    return figures;
}

/// For every piece of `own`, its replacement at another place. If the numbers of pieces differ, the pieces that differ
/// between equal ones before and after them form one group.
std::vector<json> kept_of(const std::vector<SliderPiece>& own, const std::vector<SliderPiece>& there) {
    const std::size_t n = own.size(), m = there.size(), fewer = std::min(n, m);
    std::vector<json> kept(n);
    std::size_t before = 0, behind = 0;
    if (n == m) before = n;
    while (n != m && before + 1 < fewer && own[before].html == there[before].html) ++before;
    while (n != m && before + behind + 1 < fewer && own[n - 1 - behind].html == there[m - 1 - behind].html) ++behind;
    for (std::size_t i = 0; i < before; ++i) kept[i] = kept_of(own[i], there[i]);
    for (std::size_t i = 1; i <= behind; ++i) kept[n - i] = kept_of(own[n - i], there[m - i]);
    if (n == m) return kept;
    std::string between;
    for (std::size_t i = before; i < m - behind; ++i) between += there[i].with_plots + "\n";
    for (std::size_t i = before; i < n - behind; ++i) kept[i] = i == before ? between : "";
    return kept;
}

/// All that a document shows of a run but its figures' curves.
std::string words_of(const DocumentSource& source) {
    std::string words = source.cells.text;
    const RunRecord& record = *source.record;
    for (const auto& [name, value] : record.values) words += name + "\n" + value.text + "\n";
    for (const auto& [name, text] : record.texts) words += name + "\n" + text.markdown + "\n";
    for (const auto& [name, figure] : record.figures) words += name + "\n" + figure.caption + "\n";
    for (const auto& [name, table] : record.tables) {
        words += name + "\n" + fmt::format("{}", fmt::join(table.header, "\n"));
        for (const auto& row : table.rows) words += fmt::format("\n{}", fmt::join(row, "\n"));
    }
    return words;
}

/// The place of a cell's controls: after this chunk, the cell's last or the last before the cell.
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

/// Title page and table of contents, which precede the first chunk.
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

}  // namespace

std::vector<std::vector<std::size_t>> SliderGroup::combinations() const {
    std::vector<std::vector<std::size_t>> all = {{}};
    for (const PlacedSlider& slider : sliders) {
        std::vector<std::vector<std::size_t>> longer;
        for (const std::vector<std::size_t>& places : all)
            for (std::size_t i = 0; i < slider.values.size(); ++i) {
                longer.push_back(places);
                longer.back().push_back(i);
            }
        all = std::move(longer);
    }
    return all;
}

std::vector<double> places_of(const RecordedSlider& slider, std::size_t max_count) {
    std::vector<double> values;
    const double steps = slider.step ? std::floor((slider.to - slider.from) / *slider.step + 1e-9) : 0;
    const double count = std::min<double>(slider.step ? steps + 1 : double{kPlacesWithoutSteps}, double(max_count));
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

std::vector<SliderGroup> slider_groups(const RunRecord& record) {
    std::vector<PlacedSlider> all;
    for (const auto& [name, slider] : record.sliders) all.push_back({name, slider, places_of(slider)});
    std::sort(all.begin(), all.end(),
              [](const PlacedSlider& a, const PlacedSlider& b) { return a.slider.order < b.slider.order; });
    std::vector<SliderGroup> groups;
    for (PlacedSlider& slider : all) {
        const auto same_cell = [&](const SliderGroup& group) { return group.cell == slider.slider.cell; };
        auto group = std::find_if(groups.begin(), groups.end(), same_cell);
        if (group == groups.end()) group = groups.insert(groups.end(), {slider.slider.cell, {}});
        group->sliders.push_back(std::move(slider));
    }
    for (SliderGroup& group : groups) {
        double combinations = 1;
        for (const PlacedSlider& slider : group.sliders) combinations *= static_cast<double>(slider.values.size());
        const double max_count = std::pow(kMaxCombinations, 1 / static_cast<double>(group.sliders.size()));
        for (PlacedSlider& slider : group.sliders) {
            if (combinations > kMaxCombinations)
                slider.values = places_of(slider.slider, std::max<std::size_t>(2, static_cast<std::size_t>(max_count)));
            const auto own = std::find(slider.values.begin(), slider.values.end(), slider.slider.value);
            slider.shown = static_cast<std::size_t>(own - slider.values.begin());
        }
    }
    return groups;
}

/// What is known of the page so far.
struct SliderPage::Parts {
    struct Group : SliderGroup {
        std::vector<std::vector<json>> kept;  ///< for each combination what each piece is there
        std::size_t combination_count = 1, shown = 0;
    };
    std::vector<Group> groups;
    ChunkSetter setter{true};
    std::vector<SliderPiece> drawn, own;  ///< of the run, as a printer needs it and as its places are compared with
    std::vector<std::size_t> controls;    ///< the piece that precedes the controls of each group
    std::string words;
};

SliderPage::SliderPage(const DocumentSource& run, const PercentScript& script, std::vector<SliderGroup> groups)
    : parts_(std::make_unique<Parts>()) {
    const SetDocument document = parts_->setter.set(run, false);
    parts_->drawn = placed_pieces(document, *run.record, true);
    parts_->own = placed_pieces(document, *run.record, false);
    parts_->words = words_of(run);
    for (SliderGroup& given : groups) {
        parts_->controls.push_back(chunk_before_control(document.chunks, script, given.cell));
        Parts::Group& group = parts_->groups.emplace_back();
        static_cast<SliderGroup&>(group) = std::move(given);
        for (const PlacedSlider& slider : group.sliders) {
            group.shown = group.shown * slider.values.size() + slider.shown;
            group.combination_count *= slider.values.size();
        }
        if (group.shown == 0) group.kept.emplace_back(parts_->own.size());
    }
}

SliderPage::~SliderPage() = default;

void SliderPage::add(std::size_t number, const DocumentSource& there) {
    Parts::Group& group = parts_->groups[number];
    const RunRecord& record = *there.record;
    if (words_of(there) == parts_->words) {
        std::vector<json> kept;
        for (const SliderPiece& own : parts_->own) {
            SliderPiece moved{own.html, own.figures, {}, {}};
            for (const std::string& figure : own.figures) moved.plots.push_back(record.figures.at(figure).plot);
            kept.push_back(kept_of(own, moved));
        }
        group.kept.push_back(std::move(kept));
    } else {
        group.kept.push_back(kept_of(parts_->own, placed_pieces(parts_->setter.set(there, false), record, false)));
    }
    if (group.kept.size() == group.shown) group.kept.emplace_back(parts_->own.size());
}

std::string SliderPage::page(const std::string& made) const {
    const std::string opens = "<main>\n", closes = "</main>";
    const std::size_t begin = made.find(opens), end = made.rfind(closes);
    if (begin == std::string::npos || end == std::string::npos) return made;
    json list = json::array();
    std::map<std::size_t, std::string> controls;
    for (std::size_t g = 0; g < parts_->groups.size(); ++g) {
        const Parts::Group& group = parts_->groups[g];
        json sliders = json::array(), pieces = json::object();
        for (const PlacedSlider& slider : group.sliders) {
            controls[parts_->controls[g]] +=
                fmt::format("<div class=\"slider\" data-group=\"{}\" data-number=\"{}\"></div>\n", g, sliders.size());
            sliders.push_back({{"name", slider.name},
                               {"label", slider.slider.label},
                               {"unit", slider.slider.unit},
                               {"values", slider.values},
                               {"shown", slider.shown}});
        }
        for (std::size_t k = 0; k < parts_->own.size(); ++k) {
            json places = json::array();
            for (const std::vector<json>& kept : group.kept) places.push_back(kept[k]);
            if (std::any_of(places.begin(), places.end(), [](const json& place) { return !place.is_null(); }))
                pieces[std::to_string(k)] = std::move(places);
        }
        list.push_back({{"sliders", sliders}, {"pieces", pieces}});
    }
    std::string main = before_chunks(made.substr(begin + opens.size(), end - begin - opens.size()));
    for (std::size_t k = 0; k < parts_->drawn.size(); ++k) {
        main += fmt::format("<div class=\"piece\" id=\"piece-{}\">\n{}\n</div>\n", k, parts_->drawn[k].with_plots);
        if (controls.contains(k)) main += controls[k];
    }
    const std::string data = replaced(list.dump(-1, ' ', true, json::error_handler_t::replace), "<", "\\u003c");
    main += "<script type=\"application/json\" class=\"slider-places\">" + data + "</script>\n";
    return made.substr(0, begin + opens.size()) + main + made.substr(end);
}

}  // namespace dynlab::inline documents
