#include "web/page_checks.h"

#include <set>

#include "base/languages.h"
#include "course/checks/read_checks.h"
#include "course/grading/pack_file.h"
#include "course/intake/folder_copy.h"
#include "data_io/mat_file.h"
#include "data_io/values/json_values.h"
#include "numerics/plants/plant_catalog.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "scripting/interpreter/catalog.h"
#include "web/page_world.h"
#include "workflow/variant_data.h"

namespace dynlab::inline web {
namespace {

namespace fs = std::filesystem;

const fs::path kDataFolder = "/records";
constexpr std::int64_t kCheckTime = 20000;  // ms of one check

/// One check, in the words of the page's language.
struct ShownCheck {
    std::string id, about, hint, message;
    double points = 0, earned = 0;
    bool tried = true;  ///< not what is marked by hand or looked at in a document
};
DYNLAB_DESCRIBE(ShownCheck, id, about, hint, message, points, earned, tried)

struct CheckedNews {
    std::string kind = "checked";
    std::vector<ShownCheck> checks;
    std::string trouble;  ///< why the script stopped
};
DYNLAB_DESCRIBE(CheckedNews, kind, checks, trouble)

/// While it lives, a data set is another one.
class ReplacedDataSet {
  public:
    ReplacedDataSet(const std::string& data_set, const fs::path& replacement)
        : place_(shared_folder() / "data" / data_set),
          replacement_(replacement),
          aside_(kDataFolder / "aside" / data_set) {
        fs::create_directories(aside_.parent_path());
        if (fs::exists(place_)) fs::rename(place_, aside_);
        fs::rename(replacement_, place_);
    }
    ~ReplacedDataSet() {
        std::error_code error;
        fs::rename(place_, replacement_, error);
        if (fs::exists(aside_)) fs::rename(aside_, place_, error);
    }
    ReplacedDataSet(const ReplacedDataSet&) = delete;
    ReplacedDataSet& operator=(const ReplacedDataSet&) = delete;

  private:
    fs::path place_, replacement_, aside_;
};

/// The submission and the data sets that its checks use.
class CheckedWork {
  public:
    explicit CheckedWork(const ChecksOrder& order)
        : order_(order), script_(parse_percent_script(order.source, order.file)) {
        fs::remove_all(kDataFolder);
        job_.files = {{"checks.lua", order.checks, true}};
        job_.hidden_folder = kDataFolder / kHiddenDataSets;
        job_.time_ms = kCheckTime;
        job_.clock_multiple = 5;
        submission_.work.source = order.source;
        fs::create_directories(job_.hidden_folder);
    }

    CheckedNews checked() {
        ReadChecks read(job_, nullptr);
        if (read.error()) throw EnvironmentError(*read.error());
        const CheckResults listed = read.listed({});
        make_data_sets(read, listed);
        std::set<std::string> runs = {kMainRun};
        for (const EvaluatedCheck& one : listed.checks)
            if (!one.check.rerun.empty()) runs.insert(one.check.rerun);
        for (const std::string& run : runs) submission_.work.runs[run] = run_on(run);
        CheckedNews news;
        ReadChecks checks(job_, &submission_);
        for (const EvaluatedCheck& one : checks.evaluated()) news.checks.push_back(shown(one));
        if (const auto& error = submission_.work.runs.at(kMainRun).error) news.trouble = text(*error);
        return news;
    }

  private:
    std::uint32_t drawn(const std::string& what) const { return drawn_number("", order_.lesson, what); }
    std::string text(const Message& message) const {
        return message_text(message, {catalog_of(script_.header.language), &option_name, &authors_});
    }

    /// The folder of a hidden data set, or of that of a rerun.
    fs::path place_of(const std::string& data_set, const std::string& run) const {
        return run == kHiddenDataSets ? job_.hidden_folder : kDataFolder / data_set;
    }

    /// Creates hidden data sets of the plants that the checks mention, and data sets of reruns.
    void make_data_sets(ReadChecks& read, const CheckResults& listed) {
        std::set<std::string> reruns;
        for (const EvaluatedCheck& one : listed.checks)
            if (!one.check.rerun.empty() && one.check.rerun != kOtherSeedRun) reruns.insert(one.check.rerun);
        for (const std::string& rerun : reruns) {
            fs::create_directories(kDataFolder / rerun);
            write_file_atomically(kDataFolder / rerun / "SOURCE.md", "A record.\n");
        }
        for (const Plant& plant : plant_catalog()) {
            if (order_.checks.find(plant.name) == std::string::npos) continue;
            for (const std::string& run : {std::string(kHiddenDataSets), plant.name}) {
                if (run != kHiddenDataSets && !reruns.contains(run)) continue;
                const PlantChoice choice{.variant_number = drawn(plant.name), .seed = drawn(noise_of(plant.name, run))};
                submission_.variants[run][plant.name] = choice.variant_number;
                write_variant_data(plant.name, choice, place_of(plant.name, run));
            }
        }
        for (const std::string& plant : listed.plants) {
            for (const std::string& run : {std::string(kHiddenDataSets), plant}) {
                if (run != kHiddenDataSets && !reruns.contains(run)) continue;
                const std::uint32_t variant_number = drawn(plant);
                const CheckResults made = read.listed({{plant, variant_number, drawn(noise_of(plant, run))}});
                if (made.error) throw EnvironmentError(*made.error);
                VariableTable variables;
                for (const auto& [name, values] : made.data_sets.at(0))
                    variables[name] = {
                        Vector(Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size())))};
                write_mat_file(place_of(plant, run) / (plant + ".mat"), variables);
                submission_.variants[run][plant] = variant_number;
            }
        }
    }

    GradedRun run_on(const std::string& name) {
        std::optional<ReplacedDataSet> replacement;
        if (name != kMainRun && name != kOtherSeedRun) replacement.emplace(name, kDataFolder / name);
        ReportLanguage language{script_.header.language};
        RunOptions options;
        options.seed = name == kOtherSeedRun ? drawn("seed") : script_.header.seed;
        options.script_folder = script_.file.parent_path();
        options.out_folder = kDataFolder / "out";
        options.memory_limit_bytes = std::size_t{512} << 20;
        options.graded = true;
        GnuplotRenderer renderer;
        Runtime runtime(options, renderer);
        runtime.services().language = &language;
        report_progress(0, {});
        return graded_run(runtime.run(script_), script_);
    }

    ShownCheck shown(const EvaluatedCheck& one) const {
        ShownCheck check{one.check.id, text(Message::verbatim(one.check.about)),
                         text(Message::verbatim(one.check.hint)), text(one.message), one.check.points};
        check.tried = !one.check.by_hand && !one.check.document;
        if (check.tried) check.earned = check.points * one.share.value_or(0);
        return check;
    }

    const ChecksOrder& order_;
    PercentScript script_;
    Catalog authors_{order_.authors};
    ChecksJob job_;
    SubmissionToGrade submission_;
};

}  // namespace

void try_checks_of_page(const ChecksOrder& order) {
    send_json(json_of(CheckedWork(order).checked()));
}

void pack_of_page(const fs::path& folder, const fs::path& file) {
    write_file_atomically(file, pack_of(contents_of(folder)).bytes);
}

}  // namespace dynlab::inline web
