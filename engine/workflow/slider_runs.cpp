#include "workflow/slider_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "documents/html/plot_data.h"
#include "documents/html/slider_page.h"
#include "figures/french_texts.h"
#include "platform/atomic_file.h"
#include "scripting/memoized_calls/call_cache.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {

std::vector<std::filesystem::path> add_slider_places(const ReportRequest& request, const RunRecord& record,
                                                     GnuplotRenderer& renderer, CallCache& calls,
                                                     const std::filesystem::path& work_folder) {
    if (record.sliders.empty() || record.error) return {};
    const bool french = request.script.header.language == "fr";
    std::deque<RunRecord> records;  // documents point at them
    const auto run_at = [&](const std::string& name, double value) -> const RunRecord& {
        RunRequest run{.script = request.script,
                       .seed = request.seed,
                       .slider_values = request.slider_values,
                       .out_folder = work_folder,
                       .print = {},
                       .enter_cell = {},
                       .stay_in_folder = request.stay_in_folder,
                       .call_cache = &calls};
        run.slider_values[name] = value;
        RunRecord& there = records.emplace_back(run_script(run, renderer));
        for (auto& [figure_name, figure] : there.figures)
            figure.plot = plot_data(french ? in_french(figure.figure) : figure.figure, french);
        return there;
    };
    std::vector<SliderPlaces> sliders;
    for (const auto& [name, slider] : record.sliders) {
        SliderPlaces places{name, slider, places_of(slider), {}, 0};
        for (std::size_t i = 0; i < places.values.size(); ++i) {
            const bool own = places.values[i] == slider.value;
            if (own) places.shown = i;
            if (request.step && !own)
                request.step(fmt::format("slider {}, place {} of {}", name, i + 1, places.values.size()));
            places.documents.push_back(document_source(request, own ? record : run_at(name, places.values[i])));
        }
        sliders.push_back(std::move(places));
    }
    std::sort(sliders.begin(), sliders.end(),
              [](const SliderPlaces& a, const SliderPlaces& b) { return a.slider.order < b.slider.order; });
    write_file_atomically(request.output, page_with_sliders(read_file(request.output), request.script, sliders));
    std::vector<std::filesystem::path> read;
    for (const RunRecord& there : records) read.insert(read.end(), there.files_read.begin(), there.files_read.end());
    return read;
}

}  // namespace dynlab::inline workflow
