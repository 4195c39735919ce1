// The course's experiments from scripts. Oracles: the stored data, which are those of seed 1; the models themselves.
#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/plants/plant_catalog.h"
#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace test_script_plants {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;

TEST(script_plants, repeat_the_stored_data) {
    EXPECT_EQ(printed("local function compare(name, made, stored)\n"
                      "  for key, value in pairs(made) do\n"
                      "    if type(value) == 'table' then compare(name .. '.' .. key, value, stored[key])\n"
                      "    elseif norm(value - stored[key]) > 1e-6*(1 + norm(value)) then print(name, key) end\n"
                      "  end\n"
                      "end\n"
                      "for name in pairs(plant()) do compare(name, plant(name), load(name)) end\n"
                      "print('done')"),
              "done\n");
}

TEST(script_plants, truth_of_the_linear_system_leaves_only_noise) {
    EXPECT_EQ(printed("local record, truth = plant('linear_system', {seed = 9}), true_model('linear_system')\n"
                      "local e = record.y - lsim(truth.G, record.u, 0.05)\n"
                      "print(math.abs(std(e)/truth.noise_std - 1) < 0.1)"),
              "true\n");
}

TEST(script_plants, static_curve_of_the_thruster_ends_at_its_greatest_thrusts) {
    EXPECT_EQ(printed("local truth = true_model('thruster')\n"
                      "print(truth.thrust[1] == truth.reverse_thrust, truth.thrust[81] == truth.forward_thrust, "
                      "truth.pwm[41] == truth.neutral, truth.thrust[41])"),
              "true\ttrue\ttrue\t0\n");
}

TEST(script_plants, refuse_what_there_is_not) {
    std::string names;
    for (const Plant& plant : plant_catalog()) names += (names.empty() ? "" : ", ") + plant.name;
    const std::string expected = "unknown simulated plant 'cranes'; the plants are " + names;
    EXPECT_NE(error_of("plant('cranes')").find(expected), std::string::npos) << error_of("plant('cranes')");
    EXPECT_NE(error_of("true_model('cranes')").find(expected), std::string::npos);
}

/// The text from `head` on that belongs to it: up to the next point of a list or the next heading.
std::string point_of(const std::string& page, const std::string& head) {
    const std::size_t at = page.find(head);
    if (at == page.npos) return "";
    return page.substr(at, std::min(page.find("\n- ", at + 1), page.find("\n#", at + 1)) - at);
}

/// The rows of a table whose first cell is `name`; those behind the first leave it empty.
std::string rows_of(const std::string& page, const std::string& name) {
    const std::size_t at = page.find("\n| `" + name + "` ");
    return at == page.npos ? "" : page.substr(at, std::min(page.find("\n| `", at + 1), page.find("\n\n", at)) - at);
}

// oracle: the plant catalog, the fields of its true models and the names of its experiments
TEST(script_plants, stand_in_the_help_pages) {
    const std::string plant_page = page_text(*find_help_page("plant"), find_function("plant")),
                      truth_page = page_text(*find_help_page("true_model"), find_function("true_model"));
    for (const Plant& plant : plant_catalog()) {
        EXPECT_NE(point_of(plant_page, "\n- `name`:").find('"' + plant.name + '"'), std::string::npos) << plant.name;
        const std::string experiments = rows_of(plant_page, plant.name);
        for (const std::string& experiment : plant.experiments)
            EXPECT_NE(experiments.find('`' + experiment + '`'), std::string::npos) << plant.name << ' ' << experiment;
        const std::string truth = rows_of(truth_page, plant.name);
        for (const PlantValue& field : plant.truth(0))
            EXPECT_NE(truth.find('`' + field.name + '`'), std::string::npos) << plant.name << ' ' << field.name;
    }
}

// oracle: the fields of the data sets
TEST(script_plants, are_described_by_the_signals_that_their_records_have) {
    EXPECT_EQ(printed("local function count(t) local n = 0; for _ in pairs(t) do n = n + 1 end; return n end\n"
                      "for name, about in pairs(plant()) do\n"
                      "  local record = plant(name)\n"
                      "  local experiments = #about.experiments > 0 and record or {[name] = record}\n"
                      "  if #about.experiments > 0 and count(record) ~= #about.experiments then print(name) end\n"
                      "  for _, experiment in pairs(experiments) do\n"
                      "    if count(experiment) ~= #about.signals then print(name, #about.signals) end\n"
                      "    for _, signal in ipairs(about.signals) do\n"
                      "      if #experiment[signal] == 0 then print(name, signal) end\n"
                      "    end\n"
                      "  end\n"
                      "  if about.units.t ~= 's' or about.title == '' then print(name, about.title) end\n"
                      "end\n"
                      "print(plant().crane.units.theta, plant().linear_system.units.u, plant().crane.experiments[4])"),
              "rad\tnil\tfree_swing\n");
}

TEST(script_plants, unknown_fields_are_reported_at_every_level) {
    for (const std::string table : {"load('crane')", "plant('crane')"}) {
        EXPECT_NE(
            error_of("print(" + table + ".estimaton)")
                .find("the data of 'crane' have no variable 'estimaton'; the variables are estimation, free_swing"),
            std::string::npos);
        EXPECT_NE(error_of("print(" + table + ".steps.phi)")
                      .find("the data of 'crane.steps' have no variable 'phi'; the variables are t, theta, u, x"),
                  std::string::npos);
    }
    EXPECT_NE(error_of("print(true_model('suspension').wn)")
                  .find("the data of 'true_model(\"suspension\")' have no variable 'wn'; the variables are"),
              std::string::npos);
}

}  // namespace test_script_plants
