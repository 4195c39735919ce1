#pragma once
#include <memory>
#include <string>

#include "base/reader.h"
#include "data_io/tables/import_options.h"

namespace dynlab::inline figures {
struct Figure;
}

namespace dynlab::inline workflow {

/// What `dynlab inspect` shows of a data file.
struct DataSummary {
    std::string text;  ///< what was read: notes, columns with units and ranges, sampling, gaps, first rows
    std::shared_ptr<const Figure>
        figure;  ///< the signals over time (over the samples where it is unknown); at most eight
};

/// `name`: a data file or a data set. Throws EnvironmentError as load_data().
DataSummary summarize_data(const std::string& name, const ImportOptions& options, const Reader& reader = {});

}  // namespace dynlab::inline workflow
