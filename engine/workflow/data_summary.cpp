#include "workflow/data_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data_io/dataset_index.h"
#include "figures/plots/id_plot.h"
#include "platform/terminal/terminal_text.h"
#include "platform/utf8.h"

namespace dynlab::inline workflow {
namespace {

using TextRows = std::vector<std::vector<std::string>>;

/// Rows with their cells below each other.
std::string aligned(const TextRows& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t j = 0; j < row.size(); ++j) widths[j] = std::max(widths[j], columns_of(row[j]));
    }
    std::string text;
    for (const auto& row : rows) {
        std::string line = " ";
        for (std::size_t j = 0; j < row.size(); ++j)
            line += " " + row[j] + std::string(widths[j] - columns_of(row[j]) + 1, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

/// A vector of the file, or a column of a matrix in it.
struct LookedSignal {
    std::string name, unit;
    Vector numbers;
};

class DataLooker {
  public:
    DataLooker(LoadedData data, const ImportOptions& options, const Reader& reader)
        : data_(std::move(data)), reader_(reader) {
        names_ = data_.columns;
        std::set<std::string> known(names_.begin(), names_.end());
        for (const auto& [name, variable] : data_.variables)
            if (known.insert(name).second) names_.push_back(name);
        for (const std::string& name : names_) collect(name, data_.variables.at(name));
        find_length();
        if (usual_length(data_) != samples_) data_.time = find_clock(data_, samples_, options);
    }

    DataSummary look() const {
        DataSummary shown;
        shown.text = title() + notes() + columns() + sampling() + first_rows();
        shown.text = terminal_text(shown.text);
        shown.figure = figure();
        return shown;
    }

  private:
    std::string text(const Message& message) const { return message_text(message, reader_); }

    std::string short_number(double number) const {
        constexpr int kDigits = 6;
        return std::isfinite(number) ? number_text(significant(number, kDigits), reader_) : "";
    }

    std::string unit_of(const std::string& name) const {
        const auto unit = data_.units.find(name);
        return unit == data_.units.end() ? "" : unit->second;
    }

    void collect(const std::string& name, const Variable& variable) {
        if (const auto* vector = std::get_if<Vector>(&variable.value))
            signals_.push_back({name, unit_of(name), *vector});
        if (const auto* matrix = std::get_if<Matrix>(&variable.value))
            for (Index j = 0; j < matrix->cols() && j < kMaxPanels; ++j)
                signals_.push_back({fmt::format("{}{}", name, j + 1), "", matrix->col(j)});
    }

    /// The length of the data is that of most signals.
    void find_length() {
        std::map<Index, int> times;
        for (const LookedSignal& signal : signals_) ++times[signal.numbers.size()];
        int highest = 0;
        for (const auto& [length, count] : times)
            if (count >= highest) highest = count, samples_ = length;
    }

    std::string title() const {
        const std::string file = data_.file.filename().string();
        if (data_.columns.empty())
            return text(Message("{}: {}", file, plural(data_.variables.size(), "{} variable", "{} variables"))) + "\n";
        return text(Message("{}: a table of {} and {}", file, plural(data_.columns.size(), "{} column", "{} columns"),
                            plural(data_.rows, "{} row", "{} rows"))) +
               "\n";
    }

    std::string notes() const {
        std::string lines;
        for (const Message& note : data_.notes) lines += fmt::format("- {}\n", text(note));
        return lines;
    }

    std::string columns() const {
        TextRows rows = {{text(data_.columns.empty() ? Message("variable") : Message("column")), text(Message("unit")),
                          text(Message("content")), text(Message("missing")), text(Message("smallest")),
                          text(Message("largest")), text(Message("mean"))}};
        for (const std::string& name : names_) add_rows(rows, name, data_.variables.at(name));
        return "\n" + aligned(rows);
    }

    void add_rows(TextRows& rows, const std::string& name, const Variable& variable) const {
        rows.push_back(row_of(name, variable));
        if (const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&variable.value))
            for (const auto& [field, value] : **table) add_rows(rows, name + "." + field, value);
    }

    std::vector<std::string> row_of(const std::string& name, const Variable& variable) const {
        std::vector<std::string> row = {name, unit_of(name)};
        if (const auto* number = std::get_if<double>(&variable.value)) {
            row.push_back(text(Message("the number {}", short_number(*number))));
        } else if (const auto* vector = std::get_if<Vector>(&variable.value)) {
            row.push_back(text(plural(vector->size(), "{} number", "{} numbers")));
            add_range(row, *vector);
        } else if (const auto* matrix = std::get_if<Matrix>(&variable.value)) {
            row.push_back(text(Message("{} x {} numbers", matrix->rows(), matrix->cols())));
            add_range(row, matrix->reshaped());
        } else if (const auto* list = std::get_if<std::shared_ptr<VariableList>>(&variable.value)) {
            row.push_back(text(data_.columns.empty() ? plural(std::ssize(**list), "{} entry", "{} entries")
                                                     : plural(std::ssize(**list), "{} string", "{} strings")));
        } else if (std::holds_alternative<std::shared_ptr<VariableTable>>(variable.value)) {
            row.push_back(text(Message("a structure")));
        } else if (const auto* words = std::get_if<std::string>(&variable.value)) {
            row.push_back(text(Message("the string \"{}\"", *words)));
        } else {
            row.push_back(text(std::holds_alternative<bool>(variable.value) ? Message("true or false")
                                                                            : Message("complex numbers")));
        }
        return row;
    }

    void add_range(std::vector<std::string>& row, const Vector& numbers) const {
        double lowest = INFINITY, highest = -INFINITY, sum = 0;
        Index count = 0;
        for (const double number : numbers) {
            if (std::isnan(number)) continue;
            lowest = std::min(lowest, number), highest = std::max(highest, number), sum += number, ++count;
        }
        const Index missing = numbers.size() - count;
        row.push_back(missing > 0 ? fmt::format("{}", missing) : "");
        if (count > 0)
            row.insert(row.end(),
                       {short_number(lowest), short_number(highest), short_number(sum / static_cast<double>(count))});
    }

    const std::optional<Clock>& clock() const { return data_.time.clock; }

    std::string seconds(double value) const { return short_number(value) + " s"; }

    std::string sampling() const {
        const auto stated = data_.variables.find("Ts");
        const double* Ts = stated == data_.variables.end() ? nullptr : std::get_if<double>(&stated->second.value);
        std::string lines;
        if (Ts != nullptr) lines = line(Message("sampling time: {} s, as specified in the file", short_number(*Ts)));
        if (signals_.empty()) return lines;
        if (clock()) return lines + line(time()) + gaps();
        if (data_.time.question) return lines + line(*data_.time.question);
        return Ts != nullptr
                   ? lines
                   : line(Message("sampling time: unknown; no column is named t or time or has a unit of time"));
    }

    std::string line(const Message& message) const { return "\n" + text(message) + "\n"; }

    Message time() const {
        const Vector& t = clock()->t;
        const InstantSpacing& spacing = clock()->spacing;
        const std::string begin = seconds(t[0]), end = seconds(t[samples_ - 1]), step = seconds(spacing.step);
        return spacing.even ? Message("time: column {}, from {} to {}, every {}", clock()->name, begin, end, step)
                            : Message("time: column {}, from {} to {}, irregular, median step {}", clock()->name, begin,
                                      end, step);
    }

    std::string gaps() const {
        const Vector& t = clock()->t;
        const InstantSpacing& spacing = clock()->spacing;
        if (spacing.gaps.empty()) return "";
        constexpr std::size_t kMaxGaps = 5;
        MessageList first{{}, Join::kSemicolon};
        for (std::size_t i = 0; i < std::min(kMaxGaps, spacing.gaps.size()); ++i) {
            const Index at = spacing.gaps[i];
            first.items.push_back(Message("{} after {} s", seconds(t[at + 1] - t[at]), short_number(t[at])));
        }
        if (spacing.gaps.size() > kMaxGaps) first.items.push_back(Message::verbatim("..."));
        return text(Message("gaps: {} ({})", spacing.gaps.size(), first)) + "\n";
    }

    std::string first_rows() const {
        constexpr std::size_t kRows = 5, kMaxColumns = 10;
        if (data_.columns.empty()) return "";
        TextRows table(1 + std::min(kRows, static_cast<std::size_t>(data_.rows)));
        for (std::size_t j = 0; j < std::min(kMaxColumns, data_.columns.size()); ++j) {
            const std::string& name = data_.columns[j];
            const Variable& variable = data_.variables.at(name);
            const auto* numbers = std::get_if<Vector>(&variable.value);
            table[0].push_back(name);
            for (std::size_t i = 1; i < table.size(); ++i) {
                if (numbers != nullptr)
                    table[i].push_back(fmt::format("{:.10g}", (*numbers)[static_cast<Index>(i - 1)]));
                else if (const auto* texts = std::get_if<std::shared_ptr<VariableList>>(&variable.value))
                    table[i].push_back(std::get<std::string>((*texts)->at(i - 1).value));
                else
                    table[i].push_back(i == 1 ? short_number(std::get<double>(variable.value)) : "");
            }
        }
        if (data_.columns.size() > kMaxColumns)
            for (auto& row : table) row.emplace_back("...");
        return line(Message("first rows:")) + aligned(table);
    }

    /// Long data are drawn by the minimum and the maximum of each of many short stretches.
    static Curve thinned(const Vector& x, const Vector& y) {
        constexpr Index kMaxPointCount = 4000;
        Curve curve;
        if (y.size() <= kMaxPointCount) {
            curve.x = x, curve.y = y;
            return curve;
        }
        std::vector<double> xs, ys;
        for (Index k = 0; k < kMaxPointCount / 2; ++k) {
            const Index begin = k * y.size() / (kMaxPointCount / 2), end = (k + 1) * y.size() / (kMaxPointCount / 2);
            Index lowest = begin, highest = begin;
            for (Index i = begin; i < end; ++i) {
                if (!(y[i] >= y[lowest])) lowest = i;
                if (!(y[i] <= y[highest])) highest = i;
            }
            for (const Index i : {std::min(lowest, highest), std::max(lowest, highest)})
                xs.push_back(x[i]), ys.push_back(y[i]);
        }
        curve.x = Eigen::Map<const Vector>(xs.data(), static_cast<Index>(xs.size()));
        curve.y = Eigen::Map<const Vector>(ys.data(), static_cast<Index>(ys.size()));
        return curve;
    }

    std::shared_ptr<const Figure> figure() const {
        if (samples_ < 2) return nullptr;
        const bool timed = clock().has_value();
        const Vector x = timed ? clock()->t : Vector(Vector::LinSpaced(samples_, 1, static_cast<double>(samples_)));
        Figure figure;
        for (const LookedSignal& signal : signals_) {
            const bool drawable = signal.numbers.size() == samples_ && signal.numbers.array().isFinite().any();
            if (!drawable || (timed && signal.name == clock()->name)) continue;
            Panel panel;
            panel.y_label = axis_label(Message::verbatim(signal.name), signal.unit);
            panel.legend = LegendPlace::kNone;
            panel.x_range = {x[0], x[samples_ - 1]};
            panel.curves.push_back(thinned(x, signal.numbers));
            figure.panels.push_back(std::move(panel));
            if (figure.panels.size() == kMaxPanels) break;
        }
        if (figure.panels.empty()) return nullptr;
        figure.rows = static_cast<int>(figure.panels.size());
        figure.panels.back().x_label = timed ? axis_label(Message::verbatim(clock()->name), "s") : Message("sample");
        return std::make_shared<const Figure>(std::move(figure));
    }

    static constexpr Index kMaxPanels = 8;
    LoadedData data_;
    Reader reader_;
    std::vector<std::string> names_;  ///< in the file's order, or alphabetically
    std::vector<LookedSignal> signals_;
    Index samples_ = 0;
};

}  // namespace

DataSummary summarize_data(const std::string& name, const ImportOptions& options, const Reader& reader) {
    return DataLooker(load_data(name, ".", false, options), options, reader).look();
}

}  // namespace dynlab::inline workflow
