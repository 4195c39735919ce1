#pragma once
#include <string>
#include <vector>

#include "documents/document.h"
#include "documents/percent_script.h"

namespace dynlab::inline documents {

/// A slider of a page that nobody serves: the document at each of its places, the others where the run had them.
struct SliderPlaces {
    std::string name;
    RecordedSlider slider;
    std::vector<double> values;             ///< rising
    std::vector<DocumentSource> documents;  ///< beside them; their records' figures need not be drawn
    std::size_t shown = 0;                  ///< the place of the run itself, whose figures are drawn
};

/// The numbers at which a slider is tried: its steps, else 21 evenly spread (over the logarithm where it says so), at
/// most 25, always with its ends and with the number that the run had.
std::vector<double> places_of(const RecordedSlider& slider);

/// The page that DocumentMaker made of the run with its sliders: behind the cell that asks for it a control, and what
/// the document shows at its places, for report_templates/html/sliders.js. What differs is told in chunks
/// (documents/chunks), or as a whole where a place has more of them than another. Throws DocumentError for a place
/// whose document cannot be set.
std::string page_with_sliders(const std::string& page, const PercentScript& script,
                              const std::vector<SliderPlaces>& sliders);

}  // namespace dynlab::inline documents
