#include "data_io/json_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "data_io/reading_memory.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMostJsonBytes = 64u << 20;
constexpr int kDeepestJson = 100;

bool is_number(const Json& value) {
    return value.is_number() || value.is_null();
}

double number_of(const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

bool is_row(const Json& value, std::size_t length) {
    return value.is_array() && value.size() == length && std::all_of(value.begin(), value.end(), is_number);
}

Variable from_json_value(const Json& value);

VariableTable from_json_object(const Json& object) {
    VariableTable table;
    for (const auto& [name, value] : object.items()) table[name] = from_json_value(value);
    return table;
}

Variable from_json_list(const Json& list) {
    if (std::all_of(list.begin(), list.end(), is_number)) {
        Vector numbers(static_cast<Index>(list.size()));
        for (Index i = 0; i < numbers.size(); ++i) numbers[i] = number_of(list[static_cast<std::size_t>(i)]);
        return {numbers};
    }
    const std::size_t columns = list.front().size();
    if (columns > 0 && std::all_of(list.begin(), list.end(), [&](const Json& row) { return is_row(row, columns); })) {
        Matrix matrix(static_cast<Index>(list.size()), static_cast<Index>(columns));
        for (Index i = 0; i < matrix.rows(); ++i)
            for (Index j = 0; j < matrix.cols(); ++j)
                matrix(i, j) = number_of(list[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
        return {matrix};
    }
    auto entries = std::make_shared<VariableList>();
    for (const Json& entry : list) entries->push_back(from_json_value(entry));
    return {entries};
}

Variable from_json_value(const Json& value) {
    if (value.is_boolean()) return {value.get<bool>()};
    if (value.is_string()) return {value.get<std::string>()};
    if (value.is_object()) return {std::make_shared<VariableTable>(from_json_object(value))};
    if (value.is_array()) return from_json_list(value);
    return {number_of(value)};
}

Json number_json(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json json_of_variable(const Variable& variable);

struct VariableWriter {
    Json operator()(double value) const { return number_json(value); }
    Json operator()(bool value) const { return value; }
    Json operator()(const std::string& value) const { return value; }
    Json operator()(const Vector& values) const {
        Json list = Json::array();
        for (const double value : values) list.push_back(number_json(value));
        return list;
    }
    Json operator()(const Matrix& values) const {
        if (values.rows() == 1) return (*this)(Vector(values.row(0)));
        Json rows = Json::array();
        for (Index i = 0; i < values.rows(); ++i) rows.push_back((*this)(Vector(values.row(i))));
        return rows;
    }
    Json operator()(const Eigen::VectorXcd& values) const { return parts(values.real().eval(), values.imag().eval()); }
    Json operator()(const Eigen::MatrixXcd& values) const { return parts(values.real().eval(), values.imag().eval()); }
    Json operator()(const std::shared_ptr<VariableTable>& table) const {
        Json object = Json::object();
        for (const auto& [name, variable] : *table) object[name] = json_of_variable(variable);
        return object;
    }
    Json operator()(const std::shared_ptr<VariableList>& list) const {
        Json array = Json::array();
        for (const Variable& variable : *list) array.push_back(json_of_variable(variable));
        return array;
    }

  private:
    template <class Real>
    Json parts(const Real& re, const Real& im) const {
        return {{"re", (*this)(re)}, {"im", (*this)(im)}};
    }
};

Json json_of_variable(const Variable& variable) {
    return std::visit(VariableWriter{}, variable.value);
}

/// nlohmann's "[json.exception.parse_error.101] parse error at line 2, column 3: ..." from the place on.
std::string place_of(const std::string& message) {
    const std::size_t at = message.find("line ");
    return at == std::string::npos ? message : message.substr(at);
}

/// Of memory, for one value with what is made of it; lists grow by doubling.
std::size_t bytes_of(Json::parse_event_t event, const Json& parsed) {
    constexpr std::size_t kName = 96, kList = 128, kValue = 40;
    switch (event) {
        case Json::parse_event_t::key:
            return kName + 2 * parsed.get_ref<const std::string&>().size();
        case Json::parse_event_t::value:
            return kValue + (parsed.is_string() ? kName + 2 * parsed.get_ref<const std::string&>().size() : 0);
        case Json::parse_event_t::object_start:
        case Json::parse_event_t::array_start:
            return kList;
        default:
            return 0;
    }
}

}  // namespace

VariableTable read_json_file(const fs::path& file) {
    std::error_code error;
    if (fs::file_size(file, error) > kMostJsonBytes && !error)
        throw EnvironmentError("{}: JSON files of more than 64 MB are not read", file.string());
    const std::string text = read_file(file);
    std::vector<std::set<std::string>> names;
    std::size_t memory = text.size();
    const auto look = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if ((memory += bytes_of(event, parsed)) > memory_for_reading(text.size())) {
            const ReadingMegabytes megabytes = megabytes_for_reading(text.size());
            throw EnvironmentError("{}: reading it takes more than {} MB of memory, too much for a file of {} MB",
                                   file.string(), megabytes.most, megabytes.of_file);
        }
        if (depth > kDeepestJson) throw EnvironmentError("{}: more than {} levels", file.string(), kDeepestJson);
        if (event == Json::parse_event_t::object_start) names.emplace_back();
        if (event == Json::parse_event_t::object_end) names.pop_back();
        if (event == Json::parse_event_t::key && !names.back().insert(parsed.get<std::string>()).second)
            throw EnvironmentError("{}: the name \"{}\" occurs twice", file.string(), parsed.get<std::string>());
        return true;
    };
    try {
        const Json read = Json::parse(text, look);
        if (!read.is_object())
            throw EnvironmentError("{}: the outermost value must be an object, {\"name\": value, ...}", file.string());
        return from_json_object(read);
    } catch (const Json::exception& problem) {
        throw EnvironmentError("{} is no JSON: {}", file.string(), place_of(problem.what()));
    }
}

void write_json_file(const fs::path& file, const VariableTable& variables) {
    const Json object = json_of_variable({std::make_shared<VariableTable>(variables)});
    write_file_atomically(file, object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace dynlab::inline data_io
