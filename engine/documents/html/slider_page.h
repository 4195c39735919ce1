#pragma once
#include <memory>
#include <string>
#include <vector>

#include "documents/document.h"
#include "documents/percent_script.h"

namespace dynlab::inline documents {

/// A slider of a page without a server.
struct PlacedSlider {
    std::string name;
    RecordedSlider slider;
    std::vector<double> values;  ///< its places, rising
    std::size_t shown = 0;       ///< the place of the run that the page was made of
};

/// The sliders that one cell asks for: they are moved together, and there is a document for each combination.
struct SliderGroup {
    std::string cell;
    std::vector<PlacedSlider> sliders;

    /// The combinations, that of the run among them: places of the sliders, those of the last one the quickest.
    std::vector<std::vector<std::size_t>> combinations() const;
};

/// The numbers at which a slider is tried: its steps, else 21 evenly spread (over the logarithm where it says so), at
/// most so many, always with its ends and with the number that the run had.
std::vector<double> places_of(const RecordedSlider& slider, std::size_t max_count = 25);

/// The sliders of a run cell by cell, in the order of the script: as many places as places_of gives, fewer where a
/// cell's combinations would be more than 450 or so.
std::vector<SliderGroup> slider_groups(const RunRecord& record);

/// The page that DocumentMaker made of a run with sliders. Controls follow the cells that request sliders, and the page
/// contains the document's content for their places, for report_templates/html/sliders.js. The differences are stored
/// per chunk (documents/chunks); for figures, only the changed drawing data.
class SliderPage {
  public:
    /// `run` is what the page was made of, its figures drawn. Throws DocumentError where it cannot be set.
    SliderPage(const DocumentSource& run, const PercentScript& script, std::vector<SliderGroup> groups);
    ~SliderPage();
    /// The document at the next combination of the group, the run's own left out; its figures need not be drawn. Throws
    /// DocumentError where it cannot be set.
    void add(std::size_t group, const DocumentSource& there);
    std::string page(const std::string& made) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace dynlab::inline documents
