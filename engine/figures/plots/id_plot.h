#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline figures {

/// Outputs above inputs over time, one panel per channel with its name and unit; inputs held between samples are drawn
/// as stairs, an input that several curves share once, in gray. Several data objects lie over one another, told apart
/// by `labels` (one each; default: "data 1"..); a single object has a legend only when its label is given; several
/// experiments of one object follow one another as curves of their own. Throws InvalidArgument for no data, another
/// number of labels, or objects whose channels differ in number.
Figure id_plot(const std::vector<const IdData*>& data, const std::vector<std::string>& labels = {});

}  // namespace dynlab::inline figures
