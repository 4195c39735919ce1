#include "workflow/variant_data.h"

#include <fmt/format.h>

#include "data_io/dataset_index.h"
#include "data_io/mat_file.h"
#include "documents/text_lines.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/text/read_number.h"

namespace dynlab::inline workflow {

namespace fs = std::filesystem;

namespace {

constexpr int kStoredDigits = 7;
constexpr std::string_view kVariantKey = "Specimen:";
constexpr char kOwnData[] = R"(
**Your group's own data set.** It was generated as described above, but for another unit of the plant, which has
different parameters, and with different noise. `plant("{name}", {{variant = {seed}, seed = {seed}}})` generates it
again, and `true_model("{name}", {{variant = {seed}}})` returns the true values.

{key} {seed}
)";

/// The data in the form in which load() returns a MAT file: experiments as structs of vectors.
VariableTable variables_of_data(const PlantValues& simulated_data);

/// What each kind of value is in a data file.
struct AsVariable {
    Variable operator()(double value) const { return {value}; }
    Variable operator()(const Vector& value) const { return {value}; }
    Variable operator()(const TransferFunction&) const {
        throw InvalidArgument("a data set must contain signals, not models");
    }
    Variable operator()(const PlantValues& value) const {
        return {std::make_shared<VariableTable>(variables_of_data(value))};
    }
};

VariableTable variables_of_data(const PlantValues& simulated_data) {
    VariableTable variables;
    for (const PlantValue& value : simulated_data) variables[value.name] = std::visit(AsVariable(), value.value);
    return variables;
}

}  // namespace

void write_variant_data(const std::string& data_set, const PlantChoice& choice, const fs::path& folder) {
    const Plant* plant = find_plant(data_set);
    if (!plant) throw InvalidArgument("no simulated plant generates the data set '{}'", data_set);
    write_mat_file(folder / (data_set + ".mat"), variables_of_data(plant->simulated_data(choice)), kStoredDigits);
}

void write_group_data(const std::vector<std::string>& data_sets, std::uint32_t group_seed, const fs::path& folder) {
    for (const std::string& name : data_sets) {
        fs::create_directories(folder / name);
        const std::string source = read_text(shared_folder() / "data" / name / kSourceFile);
        const std::string own =
            fmt::format(kOwnData, fmt::arg("name", name), fmt::arg("seed", group_seed), fmt::arg("key", kVariantKey));
        write_file_atomically(folder / name / kSourceFile, source + own);
        write_variant_data(name, {.variant_number = group_seed, .seed = group_seed}, folder / name);
    }
}

std::optional<std::uint32_t> group_seed_of(const fs::path& data_folder) {
    for (const Plant& plant : plant_catalog()) {
        const fs::path source = data_folder / plant.name / kSourceFile;
        if (!fs::is_regular_file(source)) continue;
        for (const std::string& line : lines_of(read_text(source))) {
            if (!line.starts_with(kVariantKey)) continue;
            const std::string number = trimmed(std::string_view(line).substr(kVariantKey.size()));
            if (const auto seed = read_number<std::uint32_t>(number)) return seed;
        }
    }
    return {};
}

}  // namespace dynlab::inline workflow
