#include "data_io/clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data_io/counted_time.h"
#include "data_io/data_file.h"
#include "data_io/tables/time_text.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr double kSecondsOfDay = 86400;
constexpr int kInstantDigits = 15;  // of messages: neighbors may differ late
constexpr int kStepDigits = 6;
constexpr double kStepTolerance = 1e-3;  // relative; instants are often rounded when they are written

Message shown_step(double seconds) {
    return Message("{} s", significant(seconds, 4));
}

/// A column of times, in seconds from one stage to the next.
class Column {
  public:
    Column(const LoadedData& data, const std::string& name, const ImportOptions& options, bool given)
        : data_(data), name_(name), options_(options), given_(given) {
        clock_.name = found_.name = name;
        clock_.t = std::get<Vector>(data.variables.at(name).value);
    }

    ClockSearch settle() {
        if (!ends_whole()) return std::move(found_);
        const auto forms = data_.clocks.find(name_);
        if (!(forms == data_.clocks.end() ? count() : read(forms->second))) return std::move(found_);
        if (calendar_) clock_.t.array() -= clock_.t[0];
        clock_.spacing = spacing_of(clock_.t);
        if (clock_.spacing.disorder) return ask(disorder(*clock_.spacing.disorder));
        if (!clock_.spacing.even) take_rounding_off();
        if (clock_.spacing.even) clock_.spacing.step = written_step(clock_.spacing.step, clock_.t.size());
        doubt_stated();
        found_.clock = std::move(clock_);
        return std::move(found_);
    }

  private:
    ClockSearch ask(Message question) {
        found_.question = std::move(question);
        return std::move(found_);
    }
    bool asks(Message question) {
        found_.question = std::move(question);
        return false;
    }
    double original(Index i) const { return std::get<Vector>(data_.variables.at(name_).value)[i]; }

    bool ends_whole() {
        for (Index i = 0; i < clock_.t.size(); ++i)
            if (!std::isfinite(clock_.t[i]))
                return asks(
                    Message("the time column '{}' has no number in sample {}. Remove the rows without a time. If the "
                            "file has a second time column, split the file into two files",
                            name_, i + 1));
        return true;
    }

    std::optional<double> stated_Ts() const {
        const auto stated = data_.variables.find("Ts");
        const double* Ts = stated == data_.variables.end() ? nullptr : std::get_if<double>(&stated->second.value);
        return Ts != nullptr && *Ts > 0 ? std::optional(*Ts) : std::nullopt;
    }

    /// Numbers in a unit.
    bool count() {
        const auto unit = data_.units.find(name_);
        const TimeName name = time_name_of(name_);
        const std::string stated = !options_.time_unit.empty() ? options_.time_unit
                                   : unit != data_.units.end() ? unit->second
                                                               : name.unit.value_or("");
        double seconds = 1;
        if (!stated.empty()) {
            const auto known = seconds_of(stated, true);
            if (!known)
                return asks(Message("the time column '{}' has the unit {}, which is not a unit of time; {}", name_,
                                    stated, remedy("ms")));
            seconds = *known;
            calendar_ = clock_.t[0] * seconds > 1e8;  // since 1970, or days of a spreadsheet
        } else {
            const Counted counted = counted_unit(clock_.t, stated_Ts(), name.is_time || !given_);
            const double step = median_step(clock_.t);
            if (counted.rival && step > 0)  // else its order is wrong in any unit
                return asks(Message(
                    "the time column '{}' has no unit: {} (a sample every {}) is as likely as {} (every {}); {}", name_,
                    counted.unit.name, shown_step(step * counted.unit.seconds), counted.rival->name,
                    shown_step(step * counted.rival->seconds), remedy(counted.unit.name)));
            seconds = counted.unit.seconds, calendar_ = counted.calendar;
            const bool convention = name_ == "t" && seconds == 1;
            if (counted.assumed && !convention)
                clock_.notes.push_back(
                    Message("the time column '{}' has no unit; dynlab assumes {}, a sample every {}; {}", name_,
                            counted.unit.name, shown_step(step * seconds), remedy("ms")));
        }
        constexpr double k16 = 65536, k24 = 16777216, k32 = 4294967296;
        const std::array ranges = {k16, k24, k32, k32 / 1e3, k32 / 1e6, kSecondsOfDay / seconds};
        if (const double range = count_on(clock_.t, ranges); range > 0)
            clock_.notes.push_back(
                Message("the time column '{}' wraps around at {}; dynlab unwraps it", name_, significant(range, 10)));
        clock_.t *= seconds;
        seconds_ = seconds;
        return true;
    }
    static Message remedy(const char* unit) {
        return Message(
            "specify the unit with load(file, {time_unit = \"{}\"}), with --time-unit {} of a command, or next to the "
            "column in the workbench",
            unit, unit);
    }

    /// Times of day, or days.
    bool read(const ClockForms& forms) {
        calendar_ = true;
        const std::string& stated = options_.time_unit;
        if (forms.dated) return order_of_day_and_month(forms);
        if (forms.two_fields && stated != "h" && stated != "min")
            return asks(
                Message("the cells of the time column '{}' contain two numbers separated by a colon: hours and "
                        "minutes, or minutes and seconds. Specify the unit of the first number, h or min, for example "
                        "with load(file, {time_unit = \"h\"}) or with --time-unit h of a command",
                        name_));
        if (forms.two_fields && stated == "min") clock_.t /= 60;
        const std::array ranges = {kSecondsOfDay, kSecondsOfDay / 2};
        if (count_on(clock_.t, ranges) > 0)
            clock_.notes.push_back(
                Message("the times in '{}' pass midnight; dynlab continues them into the next day", name_));
        return true;
    }

    bool order_of_day_and_month(const ClockForms& forms) {
        constexpr const char *kDayFirst = "dd/mm/yyyy", *kMonthFirst = "mm/dd/yyyy";
        if (forms.day_first && forms.month_first)
            return asks(Message(
                "some dates in '{}' have the day first, and some have the month first. Use the same order in all rows",
                name_));
        if (!forms.either_first && !forms.month_first) return true;
        Vector swapped = clock_.t;
        for (double& seconds : swapped)
            if (const double other = with_day_as_month(seconds); std::isfinite(other)) seconds = other;
        const auto rank = [](const Vector& t) {  // how well instants follow each other
            const InstantSpacing spacing = spacing_of(t);
            return spacing.disorder ? 0 : spacing.even ? 2 : 1;
        };
        const Vector both = (clock_.t.array() - clock_.t[0]) - (swapped.array() - swapped[0]);
        const std::string& stated = options_.time_unit;
        bool month_first = forms.month_first || stated == kMonthFirst;
        if (!forms.day_first && !forms.month_first && stated != kDayFirst && stated != kMonthFirst && !both.isZero()) {
            const int day = rank(clock_.t), month = rank(swapped);
            if (day == month)
                return asks(
                    Message("the dates in '{}' are ambiguous: the first number can be the day or the month. Specify "
                            "the order with load(file, {time_unit = \"{}\"}) or load(file, {time_unit = \"{}\"}), or "
                            "with --time-unit of a command",
                            name_, kDayFirst, kMonthFirst));
            month_first = month > day;
            clock_.notes.push_back(
                Message("the dates in '{}' are read as {}, because the times then increase or are equally spaced. To "
                        "change the order, use load(file, {time_unit = \"{}\"}), or --time-unit of a command",
                        name_, month_first ? kMonthFirst : kDayFirst, month_first ? kDayFirst : kMonthFirst));
        }
        if (month_first) clock_.t = std::move(swapped);
        return true;
    }

    Message disorder(Index i) const {
        const Message place =
            Message("the time column '{}' must increase, but sample {} is {} and the next sample is {}", name_, i + 1,
                    significant(original(i), kInstantDigits), significant(original(i + 1), kInstantDigits));
        Index equal = 0, back = 0;
        for (Index k = 0; k + 1 < clock_.t.size(); ++k) {
            equal += clock_.t[k + 1] == clock_.t[k];
            back += clock_.t[k + 1] < clock_.t[k];
        }
        if (back == 0 && 2 * equal >= clock_.t.size() - 1 && clock_.t.size() % 2 == 0 && in_pairs())
            return Message(
                "{}: every time occurs twice. If the rows are the minimum and the maximum of an interval, average "
                "them. If the clock is too coarse, specify the sampling time with the command-line option --Ts or with "
                "iddata(y, u, Ts)",
                place);
        if (back == 0)
            return Message(
                "{}. Number of rows with the same time as the previous row: {}. If rows were written twice, delete the "
                "copies. If the clock is too coarse, specify the sampling time with the command-line option --Ts or "
                "with iddata(y, u, Ts)",
                place, equal);
        return Message("{}. If the recording was restarted or the clock was set, save each part in a separate file",
                       place);
    }
    bool in_pairs() const {
        for (Index k = 0; k + 1 < clock_.t.size(); k += 2)
            if (clock_.t[k] != clock_.t[k + 1]) return false;
        return true;
    }

    /// Instants that were rounded when they were written lie within that rounding of even ones.
    void take_rounding_off() {
        const Index last = clock_.t.size() - 1;
        const double step = (clock_.t[last] - clock_.t[0]) / static_cast<double>(last);
        const double rounding = seconds_ * quantum_of(clock_.t / seconds_);
        constexpr double kFine = 0.15;  // of a step; a coarser clock says too little
        const Vector even = Vector::LinSpaced(last + 1, clock_.t[0], clock_.t[last]);
        if (rounding > kFine * step || !((clock_.t - even).array().abs() <= 1.01 * rounding).all()) return;
        clock_.spacing = {step, true};
    }

    void doubt_stated() {
        constexpr double kClose = 0.01;
        const auto Ts = stated_Ts();
        const double step = clock_.spacing.step;
        if (Ts && std::abs(*Ts - step) > kClose * step)
            clock_.notes.push_back(
                Message("the file specifies Ts = {} s, but its time column '{}' advances by {} s; dynlab uses the time "
                        "column. To use another sampling time, give --Ts to a command, or Ts to iddata",
                        significant(*Ts, kStepDigits), name_, significant(step, kStepDigits)));
    }

    const LoadedData& data_;
    std::string name_;
    const ImportOptions& options_;
    bool given_, calendar_ = false;
    double seconds_ = 1;  ///< of a unit of the numbers
    Clock clock_;
    ClockSearch found_;
};

/// Columns in the file's order, else variables.
std::vector<std::string> names_in_order(const LoadedData& data) {
    std::vector<std::string> names = data.columns;
    if (names.empty())
        for (const auto& [name, variable] : data.variables) names.push_back(name);
    return names;
}

const Vector* numbers_of(const LoadedData& data, const std::string& name) {
    const auto found = data.variables.find(name);
    return found == data.variables.end() ? nullptr : std::get_if<Vector>(&found->second.value);
}

/// Whether the numbers increase, without missing ones at the end: a signal that is shorter than another in the same
/// table.
bool goes_up(const Vector& values) {
    Index count = values.size();
    while (count > 0 && std::isnan(values[count - 1])) --count;
    if (count < 2) return false;
    Index up = 0;
    for (Index i = 0; i + 1 < count; ++i) up += values[i + 1] > values[i];
    constexpr double kMax = 0.45;  // of pairs of equal times, wrapping counters
    return static_cast<double>(up) >= kMax * static_cast<double>(count - 1);
}

std::optional<double> known_seconds(const LoadedData& data, const std::string& name) {
    if (data.clocks.contains(name)) return 1;
    const auto unit = data.units.find(name);
    return seconds_of(unit != data.units.end() ? unit->second : time_name_of(name).unit.value_or(""), true);
}

/// Whether two columns are one clock, perhaps in two units or since two instants.
bool same_clock(const LoadedData& data, const std::string& name, const std::string& other) {
    const Vector &a = *numbers_of(data, name), &b = *numbers_of(data, other);
    const Index last = a.size() - 1;
    const double length_a = a[last] - a[0], length_b = b[last] - b[0];
    if (!(length_a > 0 && length_b > 0)) return false;  // also where one ends earlier
    const auto unit_a = known_seconds(data, name), unit_b = known_seconds(data, other);
    constexpr double kClose = 0.01, kSteps = 1.5;  // one may be rounded
    if (unit_a.has_value() == unit_b.has_value() &&
        std::abs(length_a * unit_a.value_or(1) - length_b * unit_b.value_or(1)) >
            kClose * length_a * unit_a.value_or(1))
        return false;
    return ((a.array() - a[0]) / length_a - (b.array() - b[0]) / length_b).abs().maxCoeff() <=
           kSteps / static_cast<double>(last);
}

}  // namespace

ClockSearch find_clock(const LoadedData& data, Index samples, const ImportOptions& options) {
    if (!options.time.empty()) {
        const auto header = data.headers.find(options.time);
        const std::string& name = header == data.headers.end() ? options.time : header->second;
        const Vector* values = numbers_of(data, name);
        if (values == nullptr || values->size() < 2)
            throw EnvironmentError(
                "{}: '{}' is not a numeric column with at least two samples, so it cannot be the time column",
                data.file.string(), options.time);
        return Column(data, name, options, true).settle();
    }
    std::vector<std::string> called, by_unit;
    for (const std::string& name : names_in_order(data)) {
        const Vector* values = numbers_of(data, name);
        if (values == nullptr || values->size() != samples || samples < 2) continue;
        const auto unit = data.units.find(name);
        const bool timed = unit != data.units.end() && seconds_of(unit->second, time_name_of(name).is_time);
        const bool is_called = time_name_of(name).is_time || data.clocks.contains(name);
        if (is_called && (unit == data.units.end() || timed)) called.push_back(name);
        if (timed) by_unit.push_back(name);
    }
    std::vector<std::string>& candidates = called.empty() ? by_unit : called;
    const auto stays = [&](const std::string& name) { return !goes_up(*numbers_of(data, name)); };
    if (candidates.size() > 1) std::erase_if(candidates, stays);
    std::vector<std::string> different;
    for (const std::string& name : candidates)
        if (std::ranges::none_of(different, [&](const std::string& other) { return same_clock(data, name, other); }))
            different.push_back(name);
    ClockSearch best;
    if (different.size() > 1) {
        best.question = Message(
            "the file has several time columns ({}), and each signal belongs to one of them. Interpolate the signals "
            "to the instants of one time column, for example an output with interp1(t_y, y, t_u)",
            listed(different));
        best.rivals = std::move(different), best.likely = true;
        return best;
    }
    for (const std::string& name : candidates) {
        ClockSearch found = Column(data, name, options, false).settle();
        found.likely = goes_up(*numbers_of(data, name));
        const bool better = found.clock && (!best.clock || (found.clock->notes.empty() && !best.clock->notes.empty()));
        if (better || (!best.clock && !best.question)) best = std::move(found);
    }
    return best;
}

double written_step(double step, Index count) {
    const double written = std::stod(fmt::format("{:.6g}", step));
    return std::abs(written - step) * static_cast<double>(count - 1) < 0.01 * step ? written : step;
}

InstantSpacing spacing_of(const Vector& instants) {
    const Index count = instants.size() - 1;
    const Vector steps = instants.tail(count) - instants.head(count);
    InstantSpacing spacing;
    for (Index i = 0; i < count; ++i) {
        if (steps[i] > 0) continue;  // false for NaN, too
        spacing.disorder = i;
        return spacing;
    }
    const double mean = steps.mean();
    spacing.even = (steps.array() - mean).abs().maxCoeff() <= kStepTolerance * mean;
    spacing.step = mean;
    if (spacing.even) return spacing;
    std::vector<double> sorted(steps.begin(), steps.end());
    std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.end());
    spacing.step = sorted[static_cast<std::size_t>(count / 2)];
    constexpr double kGap = 1.5;
    for (Index i = 0; i < count; ++i)
        if (steps[i] > kGap * spacing.step) spacing.gaps.push_back(i);
    return spacing;
}

}  // namespace dynlab::inline data_io
