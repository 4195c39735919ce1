#include "workflow/slider_runs.h"

#include <set>

#include "documents/html/slider_page.h"
#include "platform/atomic_file.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "workflow/branched_runs.h"

namespace dynlab::inline workflow {
namespace {

/// The numbers of all sliders at every combination of a group's places, but for that of the run.
std::vector<SliderNumbers> other_places(const SliderGroup& group, const SliderNumbers& chosen) {
    std::vector<SliderNumbers> all;
    for (const std::vector<std::size_t>& places : group.combinations()) {
        SliderNumbers numbers = chosen;
        bool own = true;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const PlacedSlider& slider = group.sliders[i];
            numbers[slider.name] = slider.values[places[i]];
            own = own && places[i] == slider.shown;
        }
        if (!own) all.push_back(std::move(numbers));
    }
    return all;
}

MessageList names_of(const SliderGroup& group) {
    std::vector<std::string> names;
    for (const PlacedSlider& slider : group.sliders) names.push_back(slider.name);
    return listed(names);
}

}  // namespace

std::vector<std::filesystem::path> add_slider_places(const ReportRequest& request, const RunRecord& record,
                                                     CallCache& calls, const std::filesystem::path& work_folder) {
    if (record.sliders.empty() || record.error) return {};
    const std::vector<SliderGroup> groups = slider_groups(record);
    SliderPage page(document_source(request, record), request.script, groups);
    const RunRequest run{.script = request.script,
                         .seed = request.seed,
                         .slider_values = request.slider_values,
                         .out_folder = work_folder,
                         .print = {},
                         .enter_cell = {},
                         .stay_in_folder = request.stay_in_folder,
                         .call_cache = &calls};
    std::set<std::filesystem::path> read;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::vector<SliderNumbers> places = other_places(groups[g], request.slider_values);
        std::size_t number = 0;
        run_from_cell(run, groups[g].cell, places, [&](RunRecord&& there) {
            if (request.step)
                request.step(Message("slider {}, position {} of {}", names_of(groups[g]), ++number, places.size()));
            for (auto& [name, figure] : there.figures)
                if (figure.plot.empty()) figure.plot = record.figures.at(name).plot;
            page.add(g, document_source(request, there));
            read.insert(there.files_read.begin(), there.files_read.end());
        });
    }
    write_file_atomically(request.output, page.page(read_file(request.output)));
    return {read.begin(), read.end()};
}

}  // namespace dynlab::inline workflow
