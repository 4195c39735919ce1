#include "data_io/variable_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr int kDeepestVariable = 100;

class VariableWriter {
  public:
    void table(const VariableTable& variables) {
        number(variables.size());
        for (const auto& [name, variable] : variables) {
            text(name);
            value(variable);
        }
    }
    std::string take() { return std::move(bytes_); }

  private:
    void raw(const void* data, std::size_t count) { bytes_.append(static_cast<const char*>(data), count); }
    void number(std::uint64_t count) { raw(&count, sizeof count); }
    void text(const std::string& content) {
        number(content.size());
        bytes_ += content;
    }
    template <class Derived>
    void array(const Eigen::PlainObjectBase<Derived>& values) {
        number(static_cast<std::uint64_t>(values.rows()));
        number(static_cast<std::uint64_t>(values.cols()));
        raw(values.data(), static_cast<std::size_t>(values.size()) * sizeof(typename Derived::Scalar));
    }

    /// The place of the alternative, then its content.
    void value(const Variable& variable) {
        number(variable.value.index());
        std::visit([this](const auto& content) { put(content); }, variable.value);
    }
    void put(double content) { raw(&content, sizeof content); }
    void put(bool content) { number(content); }
    void put(const std::string& content) { text(content); }
    template <class Derived>
    void put(const Eigen::PlainObjectBase<Derived>& content) {
        array(content);
    }
    void put(const std::shared_ptr<VariableTable>& content) { table(*content); }
    void put(const std::shared_ptr<VariableList>& content) {
        number(content->size());
        for (const Variable& part : *content) value(part);
    }

    std::string bytes_;
};

class VariableReader {
  public:
    explicit VariableReader(std::string_view bytes) : left_(bytes) {}

    VariableTable whole_table() {
        VariableTable variables = table(0);
        if (!left_.empty()) fail();
        return variables;
    }

  private:
    [[noreturn]] static void fail() { throw EnvironmentError("the variables were not received whole"); }

    std::string_view take(std::uint64_t count) {
        if (count > left_.size()) fail();
        const std::string_view taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }
    template <class T>
    T plain() {
        T content;
        std::memcpy(&content, take(sizeof content).data(), sizeof content);
        return content;
    }
    std::uint64_t number() { return plain<std::uint64_t>(); }
    std::string text() { return std::string(take(number())); }
    /// Every part takes at least one byte, so a larger count cannot be true.
    std::uint64_t count_of_parts() {
        const std::uint64_t count = number();
        if (count > left_.size()) fail();
        return count;
    }

    template <class Array>
    Array array() {
        using Scalar = typename Array::Scalar;
        const std::uint64_t rows = number(), columns = number();
        constexpr std::uint64_t kMost = 1ull << 31;
        if (rows > kMost || columns > kMost || (Array::ColsAtCompileTime == 1 && columns != 1)) fail();
        const std::string_view content = take(rows * columns * sizeof(Scalar));
        Array values(static_cast<Index>(rows), static_cast<Index>(columns));
        if (!content.empty()) std::memcpy(values.data(), content.data(), content.size());
        return values;
    }

    VariableTable table(int depth) {
        VariableTable variables;
        for (std::uint64_t left = count_of_parts(); left > 0; --left) {
            const std::string name = text();
            variables[name] = value(depth + 1);
        }
        return variables;
    }
    std::shared_ptr<VariableList> list(int depth) {
        auto parts = std::make_shared<VariableList>();
        for (std::uint64_t left = count_of_parts(); left > 0; --left) parts->push_back(value(depth + 1));
        return parts;
    }

    Variable value(int depth) {
        if (depth > kDeepestVariable) fail();
        switch (number()) {
            case 0:
                return {plain<double>()};
            case 1:
                return {number() != 0};
            case 2:
                return {text()};
            case 3:
                return {array<Vector>()};
            case 4:
                return {array<Matrix>()};
            case 5:
                return {array<Eigen::VectorXcd>()};
            case 6:
                return {array<Eigen::MatrixXcd>()};
            case 7:
                return {std::make_shared<VariableTable>(table(depth))};
            case 8:
                return {list(depth)};
        }
        fail();
    }

    std::string_view left_;
};

}  // namespace

std::string bytes_of(const VariableTable& variables) {
    VariableWriter writer;
    writer.table(variables);
    return writer.take();
}

VariableTable variables_of(std::string_view bytes) {
    return VariableReader(bytes).whole_table();
}

}  // namespace dynlab::inline data_io
