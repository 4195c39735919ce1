#include "workflow/site/site_data.h"

#include <nlohmann/json.hpp>

#include "data_io/csv_file.h"
#include "data_io/data_file.h"
#include "data_io/dataset_index.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr int kEveryDigit = 17;

/// The columns of a data set of vectors and a sampling time.
std::string csv_of(const VariableTable& variables) {
    CsvTable table;
    for (const auto& [name, variable] : variables) {
        const auto* const number = std::get_if<double>(&variable.value);
        if (number && name == "Ts") table.Ts = *number;
        if (const auto* const vector = std::get_if<Vector>(&variable.value)) {
            table.names.push_back(name);
            table.columns.push_back(*vector);
        }
    }
    const TemporaryFolder work;
    write_csv_file(work.path() / "record.csv", table, kEveryDigit);
    return read_file(work.path() / "record.csv");
}

}  // namespace

SiteFiles data_of_site() {
    SiteFiles files;
    nlohmann::json index = nlohmann::json::object();
    for (const std::string& name : dataset_names()) {
        SiteFiles own;
        const fs::path folder = shared_folder() / "data" / name;
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.is_regular_file()) own[entry.path().filename().string()] = read_file(entry.path());
        if (own.size() == 1 && !missing_package(name)) own[name + ".csv"] = csv_of(load_data(name, folder).variables);
        nlohmann::json list = nlohmann::json::array();
        for (auto& [file, content] : own) {
            list.push_back({{"file", file}, {"bytes", content.size()}});
            files["data/" + name + "/" + file] = std::move(content);
        }
        index[name] = std::move(list);
    }
    files["data/index.json"] = index.dump(1) + "\n";
    return files;
}

}  // namespace dynlab::inline workflow
