#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline figures {

/// Outputs above inputs over time, one panel per channel with its name and unit. Inputs with zero-order hold are drawn
/// as stairs; an input that several curves share is drawn once, in gray. Several data objects share the panels,
/// distinguished by `labels` (one each; default: "data 1"..); a single object has a legend only if its label is given.
/// Several experiments of one object follow one another as separate curves. Throws InvalidArgument for no data, another
/// number of labels, or objects whose channels differ in number.
Figure id_plot(const std::vector<const IdData*>& data, const std::vector<std::string>& labels = {});

}  // namespace dynlab::inline figures
