// The plant catalog. Oracles: the stored data sets, their CSV files' headers and SOURCE.md, which people wrote; the
// definition of a sampling time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "numerics/plants/plant_catalog.h"

namespace test_plant_catalog {

using namespace dynlab;
namespace fs = std::filesystem;
using testing::ElementsAreArray;
using testing::HasSubstr;

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const Plant& plant : dynlab::plant_catalog()) names.push_back(plant.name);
    return names;
}

class plant_catalog : public testing::TestWithParam<std::string> {
  protected:
    static const Plant& plant() { return *find_plant(GetParam()); }
    static fs::path folder() { return fs::path(DYNLAB_SOURCE_DIR) / "data" / GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(all, plant_catalog, testing::ValuesIn(all_names()),
                         [](const auto& name) { return name.param; });

std::string text_of_file(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<std::string> names_of(const PlantValues& values) {
    std::vector<std::string> names;
    for (const PlantValue& value : values) names.push_back(value.name);
    return names;
}

/// The experiments of the data set, or the data set itself.
std::vector<PlantValues> experiments_of(const Plant& plant, const PlantValues& simulated_data) {
    if (plant.experiments.empty()) return {simulated_data};
    std::vector<PlantValues> all;
    for (const PlantValue& experiment : simulated_data) all.push_back(std::get<PlantValues>(experiment.value));
    return all;
}

const Vector& signal_of(const PlantValues& values, const std::string& name) {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const PlantValue& value) { return value.name == name; });
    return std::get<Vector>(found->value);
}

TEST_P(plant_catalog, has_a_stored_data_set_that_says_its_signals) {
    const std::string source = text_of_file(folder() / "SOURCE.md");
    for (const PlantSignal& signal : plant().signals) {
        EXPECT_THAT(source, HasSubstr("`" + signal.name + "`"));
        for (const auto& entry : fs::directory_iterator(folder())) {
            if (entry.path().extension() != ".csv") continue;
            const std::string text = text_of_file(entry.path()), unit = "# unit " + signal.name + ": ";
            if (signal.unit.empty()) {
                EXPECT_EQ(text.find(unit), std::string::npos) << entry.path();
            } else {
                EXPECT_THAT(text, HasSubstr(unit + signal.unit + "\n"));
            }
        }
    }
}

TEST_P(plant_catalog, title_uses_the_terms_of_the_glossary) {
    EXPECT_THAT(plant().title, testing::Not(HasSubstr("record")));
    EXPECT_THAT(plant().title, testing::Not(HasSubstr("rig")));
}

TEST_P(plant_catalog, records_have_the_experiments_the_signals_and_the_documented_sampling) {
    const Plant& plant = this->plant();
    std::vector<std::string> signals;
    for (const PlantSignal& signal : plant.signals) signals.push_back(signal.name);
    const PlantValues simulated_data = plant.simulated_data({});
    if (!plant.experiments.empty()) {
        EXPECT_THAT(names_of(simulated_data), ElementsAreArray(plant.experiments));
    }
    for (const PlantValues& experiment : experiments_of(plant, simulated_data)) {
        EXPECT_THAT(names_of(experiment), ElementsAreArray(signals));
        const Vector& t = signal_of(experiment, "t");
        for (Index k = 1; k < t.size(); ++k) ASSERT_NEAR(t[k] - t[k - 1], plant.Ts, 1e-9 * t[k]) << k;
        for (const std::string& name : signals) EXPECT_TRUE(signal_of(experiment, name).allFinite()) << name;
    }
}

// oracle: what a choice means
TEST_P(plant_catalog, another_seed_changes_the_record_and_another_variant_the_truth) {
    const Plant& plant = this->plant();
    const auto simulated_data = [&plant](const PlantChoice& choice) {
        return signal_of(experiments_of(plant, plant.simulated_data(choice)).front(), plant.signals.back().name);
    };
    const PlantChoice stored;
    EXPECT_EQ(stored.variant_number, 0u);
    EXPECT_EQ(stored.seed, 1u);
    EXPECT_EQ(simulated_data(stored), simulated_data({.variant_number = 0, .seed = 1}));
    EXPECT_NE(simulated_data(stored), simulated_data({.variant_number = 0, .seed = 2}));
    EXPECT_NE(simulated_data(stored), simulated_data({.variant_number = 3, .seed = 1}));
    EXPECT_EQ(names_of(plant.truth(0)), names_of(plant.truth(3)));
    const auto numbers = [](const PlantValues& values) {
        std::vector<double> all;
        for (const PlantValue& value : values) {
            if (const auto* number = std::get_if<double>(&value.value)) all.push_back(*number);
            if (const auto* model = std::get_if<TransferFunction>(&value.value)) all.push_back(model->dc_gain());
        }
        return all;
    };
    EXPECT_EQ(numbers(plant.truth(3)), numbers(plant.truth(3)));
    EXPECT_NE(numbers(plant.truth(0)), numbers(plant.truth(3)));
}

TEST(rig_names, are_sorted_and_found) {
    std::set<std::string> names;
    for (const Plant& plant : dynlab::plant_catalog()) {
        EXPECT_TRUE(names.empty() || *names.rbegin() < plant.name) << plant.name;
        names.insert(plant.name);
        EXPECT_EQ(find_plant(plant.name), &plant);
    }
    EXPECT_EQ(find_plant("cranes"), nullptr);
    EXPECT_EQ(find_plant(""), nullptr);
}

}  // namespace test_plant_catalog
