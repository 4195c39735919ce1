#include "data_io/json_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "data_io/reading_memory.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMaxJsonBytes = 64u << 20;
constexpr std::size_t kMaxJsonDepth = 100;

/// Counts the memory that reading takes, and refuses more than a file of that size may take.
class ReadingMemory {
  public:
    ReadingMemory(const fs::path& file, std::size_t file_bytes)
        : file_(file), file_bytes_(file_bytes), taken_(file_bytes + kOutgrownBytes) {}
    void take(std::size_t bytes) {
        if ((taken_ += bytes) > memory_for_reading(file_bytes_))
            throw EnvironmentError(refusal_for_memory(file_, file_bytes_));
    }
    void give_back(std::size_t bytes) { taken_ -= bytes; }

  private:
    /// The allocator keeps blocks that a list outgrew, up to the size from which it maps them singly (mallopt(3)).
    static constexpr std::size_t kOutgrownBytes = std::size_t{32} << 20;
    const fs::path& file_;
    std::size_t file_bytes_, taken_;
};

constexpr std::size_t kNumberBytes = sizeof(double);
constexpr std::size_t kEntryBytes = 3 * sizeof(Variable);  // a growing list exists twice for a moment
constexpr std::size_t kMemberBytes = 128, kTableBytes = 96, kVectorBytes = 96;

std::size_t bytes_of(const std::string& text) {
    constexpr std::size_t kShort = 15;  // std::string keeps so many bytes in itself
    return text.size() > kShort ? text.size() + 32 : 0;
}

std::size_t bytes_of_vector(Index size) {
    return kVectorBytes + kNumberBytes * static_cast<std::size_t>(size);
}

/// A list whose end has not been read. It holds plain numbers, or the rows of a matrix, and becomes a list of any
/// variables with the first entry that is neither.
class OpenList {
  public:
    void add(double number, ReadingMemory& memory) {
        if (!is_mixed_ && columns_ == 0) return append(&number, 1, memory);
        add(Variable{number}, memory);
    }
    void add(Variable&& entry, ReadingMemory& memory) {
        const auto* row = std::get_if<Vector>(&entry.value);
        if (row != nullptr && row->size() > 0 && !is_mixed_ && (count_ == 0 || columns_ == row->size())) {
            columns_ = row->size();
            append(row->data(), columns_, memory);
            memory.give_back(bytes_of_vector(columns_));  // of the row itself
            return;
        }
        if (!is_mixed_) become_mixed(memory);
        add_entry(std::move(entry), memory);
    }
    Variable finished(ReadingMemory& memory) {
        if (is_mixed_) return {std::make_shared<VariableList>(std::move(entries_))};
        if (count_ > 0) numbers_.conservativeResize(count_);  // it would take memory for no number, too
        if (columns_ == 0) {
            memory.take(count_ > 0 ? kVectorBytes : 0);
            return {std::move(numbers_)};
        }
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        memory.take(kNumberBytes * static_cast<std::size_t>(count_));
        return {Matrix(Eigen::Map<const Rows>(numbers_.data(), count_ / columns_, columns_))};
    }

  private:
    /// conservativeResize reallocates, which copies no large blocks.
    void append(const double* numbers, Index size, ReadingMemory& memory) {
        memory.take(kNumberBytes * static_cast<std::size_t>(size));
        if (count_ + size > numbers_.size()) numbers_.conservativeResize(2 * numbers_.size() + size);
        std::copy_n(numbers, size, numbers_.data() + count_);
        count_ += size;
    }
    void add_entry(Variable&& entry, ReadingMemory& memory) {
        memory.take(kEntryBytes);
        entries_.push_back(std::move(entry));
    }
    void become_mixed(ReadingMemory& memory) {
        is_mixed_ = true;
        const Index rows = columns_ == 0 ? count_ : count_ / columns_;
        for (Index i = 0; i < rows; ++i) {
            if (columns_ == 0) {
                add_entry({numbers_[i]}, memory);
                continue;
            }
            memory.take(bytes_of_vector(columns_));
            add_entry({Vector(numbers_.segment(i * columns_, columns_))}, memory);
        }
        numbers_.resize(0);
    }

    Vector numbers_;  ///< the first `count_` of them; of rows, one row after the other
    Index count_ = 0, columns_ = 0;
    bool is_mixed_ = false;
    VariableList entries_;
};

/// nlohmann's "[json.exception.parse_error.101] parse error at line 2, column 3: ..." from the place on.
std::string place_of(const std::string& message) {
    const std::size_t at = message.find("line ");
    return at == std::string::npos ? message : message.substr(at);
}

/// Makes variables while nlohmann's parser reads. A tree of nlohmann's in between would take several times the memory,
/// and its parser with a callback takes a time that grows with the square of a list's length.
class VariableBuilder final : public nlohmann::json_sax<Json> {
  public:
    VariableBuilder(const fs::path& file, std::size_t file_bytes) : file_(file), memory_(file, file_bytes) {}
    VariableTable table() { return std::move(*outermost_); }

    bool null() override { return add_number(std::numeric_limits<double>::quiet_NaN()); }
    bool boolean(bool value) override { return add({value}); }
    bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
    bool string(string_t& text) override {
        memory_.take(bytes_of(text));
        return add({std::move(text)});
    }
    bool binary(binary_t&) override { return false; }  // JSON has none

    bool start_object(std::size_t) override {
        memory_.take(kTableBytes);
        begin().table = std::make_shared<VariableTable>();
        return true;
    }
    bool key(string_t& name) override {
        memory_.take(kMemberBytes + bytes_of(name));
        const auto [member, is_new] = open_.back().table->try_emplace(name);
        if (!is_new) throw EnvironmentError("{}: the name \"{}\" occurs twice", file_.string(), name);
        open_.back().member = &member->second;
        return true;
    }
    bool end_object() override {
        const std::shared_ptr<VariableTable> table = std::move(open_.back().table);
        open_.pop_back();
        if (open_.empty()) outermost_ = table;
        return open_.empty() || add({table});
    }
    bool start_array(std::size_t) override {
        if (open_.empty()) refuse_outermost();
        begin();
        return true;
    }
    bool end_array() override {
        Variable list = open_.back().list.finished(memory_);
        open_.pop_back();
        return add(std::move(list));
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& problem) override {
        throw EnvironmentError("{} is not JSON: {}", file_.string(), place_of(problem.what()));
    }

  private:
    struct Open {
        std::shared_ptr<VariableTable> table;  ///< null of a list
        Variable* member = nullptr;            ///< of the table: the one whose value comes next
        OpenList list;
    };

    [[noreturn]] void refuse_outermost() const {
        throw EnvironmentError("{}: the outermost value must be an object, {\"name\": value, ...}", file_.string());
    }
    Open& begin() {
        if (open_.size() >= kMaxJsonDepth)
            throw EnvironmentError("{}: the values are nested deeper than {} levels", file_.string(), kMaxJsonDepth);
        return open_.emplace_back();
    }
    bool add(Variable&& value) {
        if (open_.empty()) refuse_outermost();
        if (Open& top = open_.back(); top.table)
            *top.member = std::move(value);
        else
            top.list.add(std::move(value), memory_);
        return true;
    }
    bool add_number(double number) {
        if (open_.empty() || open_.back().table) return add({number});
        open_.back().list.add(number, memory_);
        return true;
    }

    const fs::path& file_;
    ReadingMemory memory_;
    std::vector<Open> open_;
    std::shared_ptr<VariableTable> outermost_;
};

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
        auto& members = object.get_ref<Json::object_t&>();
        members.reserve(table->size());  // the object's own insertion looks through all names for each
        for (const auto& [name, variable] : *table) members.emplace_back(name, json_of_variable(variable));
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

}  // namespace

VariableTable read_json_file(const fs::path& file) {
    std::error_code error;
    if (fs::file_size(file, error) > kMaxJsonBytes && !error)
        throw EnvironmentError("{}: the file exceeds the limit of 64 MB for JSON files; save the data as CSV or MAT",
                               file.string());
    const std::string text = read_file(file);
    VariableBuilder builder(file, text.size());
    Json::sax_parse(text, &builder);
    return builder.table();
}

void write_json_file(const fs::path& file, const VariableTable& variables) {
    const Json object = json_of_variable({std::make_shared<VariableTable>(variables)});
    write_file_atomically(file, object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace dynlab::inline data_io
