#include "data_io/mat_file.h"

#include <algorithm>
#include <new>

#include "data_io/mat_compression.h"
#include "data_io/mat_layout.h"
#include "data_io/mat_variable.h"
#include "data_io/reading_memory.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/described.h"
#include "data_io/values/message_values.h"
#include "platform/atomic_file.h"
#include "platform/confinement.h"
#include "platform/error.h"
#include "platform/guarded_call.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;

/// Arrays of at least this many numbers are compressed quickly rather than well, see mat_compression.h.
constexpr std::size_t kFastCompressionSize = std::size_t{1} << 19;

/// libmatio reports most damage to its log only. The log is global, so this keeps the first complaint while it
/// lives.
class MatioComplaints {
  public:
    MatioComplaints() {
        first_.clear();
        Mat_LogInitFunc("dynlab", [](int level, char* message) {
            const bool serious = level == (MATIO_LOG_LEVEL_ERROR) || level == (MATIO_LOG_LEVEL_CRITICAL);
            if (serious && first_.empty()) first_ = message;
        });
    }
    const std::string& first() const { return first_; }
    void forget() { first_.clear(); }

  private:
    static inline std::string first_;
};

/// By another's words.
[[noreturn]] void fail_damaged(const fs::path& file, const Message& how) {
    throw EnvironmentError("{} is damaged: {}", file.string(), how);
}

std::string without_line_end(std::string text) {
    text.erase(text.find_last_not_of("\r\n. ") + 1);
    return text;
}

/// libmatio does not find the names of tables and other objects, so the message gives their place instead.
Message refusal_of_object(std::size_t number, const std::string& last_name) {
    if (last_name.empty())
        return Message(
            "variable number {} is an object, a table or a string array, which dynlab cannot read; save its parts as "
            "plain arrays",
            number);
    return Message(
        "variable number {} (after {}) is an object, a table or a string array, which dynlab cannot read; save its "
        "parts as plain arrays",
        number, last_name);
}

/// The next header; nothing at the end. HDF5 finds every variable separately, so that an invalid one (a link to another
/// file) is skipped.
MatVariable next_variable(mat_t* mat, bool is_hdf5, MatioComplaints& complaints, std::vector<Message>& left_out) {
    constexpr int kMaxLost = 64;  // in a row; libmatio may report the last one forever
    for (int lost = 0; lost < kMaxLost; ++lost) {
        MatVariable variable(Mat_VarReadNextInfo(mat));
        if (variable || !is_hdf5 || complaints.first().empty()) return variable;
        const Message how = Message("a variable that is damaged or stored in another file cannot be read");
        if (left_out.empty() || left_out.back() != how) left_out.push_back(how);
        complaints.forget();
    }
    return nullptr;
}

/// What a file holds, as it comes from a guarded copy.
struct MatContent {
    VariableTable variables;
    std::vector<Message> left_out;
    Message refusal = {};  ///< why nothing was read
};

DYNLAB_DESCRIBE(MatContent, variables, left_out, refusal)

/// A guarded copy gives up opening files (a sandbox contains no others anyway). libmatio has opened its file, and HDF5
/// would follow links of a v7.3 file to others.
MatContent read_variables(const fs::path& file) {
    const MatLayout layout = check_mat_layout(file);
    MatioComplaints complaints;
    const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
    if (!mat) throw EnvironmentError("{} is damaged: it cannot be opened as a MATLAB file", file.string());
    const bool is_hdf5 = layout.version == MatVersion::k73;
    const std::size_t bytes = fs::file_size(file);
    if (is_hdf5 && is_guarded_copy()) confine_to_memory();
    MatContent content;
    std::size_t count = 0;
    std::string last_name;
    while (const MatVariable variable{next_variable(mat.get(), is_hdf5, complaints, content.left_out)}) {
        ++count;
        if (variable->class_type == MAT_C_OPAQUE) {
            if (is_hdf5) complaints.forget();
            content.left_out.push_back(refusal_of_object(count, last_name));
            continue;
        }
        const std::string name = variable->name ? variable->name : "";
        if (name.empty()) continue;  // MATLAB keeps the private data of objects in a nameless variable
        try {
            check_mat_header(*variable, name, bytes, is_hdf5);
            const bool whole = Mat_VarReadDataAll(mat.get(), variable.get()) == 0 && complaints.first().empty();
            if (!whole && !is_hdf5) break;  // what follows would be read from a wrong place
            if (!whole) throw EnvironmentError("variable {} cannot be read", name);
            content.variables[name] = from_mat(*variable, name);
            last_name = name;
        } catch (const EnvironmentError& error) {
            if (is_hdf5) complaints.forget();
            content.left_out.push_back(error.message());
        }
    }
    if (content.left_out.empty() && !complaints.first().empty())
        fail_damaged(file, Message::verbatim(without_line_end(complaints.first())));
    if (layout.variables > count) {
        if (content.left_out.empty())
            throw EnvironmentError("{} is damaged: only {} of its {} variables can be read", file.string(), count,
                                   layout.variables);
        // libmatio loses its way behind some of them.
        content.left_out.push_back(
            Message("only {} of the {} variables in the file can be read", count, layout.variables));
    }
    if (content.variables.empty() && !content.left_out.empty())
        throw EnvironmentError("{}: {}", file.string(), MessageList{content.left_out, Join::kSemicolon});
    return content;
}

MatContent read_guarded(const fs::path& file) {
    load_matio();
    const std::size_t bytes = bytes_of_file(file);
    GuardLimits limits;
    limits.memory_bytes = limits.output_bytes = memory_for_reading(bytes);
    const auto read = [&file, bytes] {
        try {
            return cbor_of(read_variables(file));
        } catch (const EnvironmentError& error) {
            return cbor_of(MatContent{{}, {}, error.message()});
        } catch (const std::bad_alloc&) {
            return cbor_of(MatContent{{}, {}, refusal_for_memory(file, bytes)});
        }
    };
    const ChildResult result = run_guarded(read, limits);
    if (result.time_limit() == TimeLimit::kProcessor)
        throw EnvironmentError("{} is damaged: reading used more than {} s of processor time", file.string(),
                               limits.time.seconds(TimeLimit::kProcessor));
    if (result.timed_out)
        throw EnvironmentError("{}: reading did not finish within {} s; try again when the machine is less busy",
                               file.string(), limits.time.seconds(TimeLimit::kClock));
    if (result.output_exceeded) throw EnvironmentError(refusal_for_memory(file, bytes));
    if (result.exit_code == 1 && !result.error_output.empty()) throw EnvironmentError(result.error_output);
    if (result.exit_code != 0) throw EnvironmentError("{} is damaged: the reader crashed", file.string());
    MatContent content;
    try {
        content = from_cbor<MatContent>(result.output);
    } catch (const ValueError& error) {
        fail_damaged(file, error.message());
    }
    if (!content.refusal.empty()) throw EnvironmentError(content.refusal);
    return content;
}

/// Numbers of a real array or of all those in a struct; 0 of anything else.
std::size_t number_count(const Variable& variable) {
    if (const auto* vector = std::get_if<Vector>(&variable.value)) return static_cast<std::size_t>(vector->size());
    if (const auto* matrix = std::get_if<Matrix>(&variable.value)) return static_cast<std::size_t>(matrix->size());
    std::size_t count = 0;
    if (const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&variable.value))
        for (const auto& [name, entry] : **table) count += number_count(entry);
    return count;
}

/// libmatio does not notice every failed write; a file cut off by a full disk is seen here.
bool holds_all(const fs::path& draft, std::size_t variables) {
    try {
        return check_mat_layout(draft).variables == variables && is_whole(draft);
    } catch (const EnvironmentError&) {
        return false;
    }
}

}  // namespace

VariableTable read_mat_file(const fs::path& file, bool guarded, std::vector<Message>* left_out) {
    MatContent content = guarded ? read_guarded(file) : read_variables(file);
    if (left_out != nullptr) *left_out = std::move(content.left_out);
    return std::move(content.variables);
}

void write_mat_file(const fs::path& file, const VariableTable& variables, int digits) {
    const TemporaryFolder folder;
    const fs::path draft = folder.path() / "draft.mat";
    const MatioComplaints complaints;
    MatFile mat(Mat_CreateVer(draft.c_str(), "MATLAB 5.0 MAT-file, written by dynlab", MAT_FT_MAT5));
    bool written = mat != nullptr;
    for (const auto& [name, variable] : variables) {
        const MatVariable converted = to_mat(variable, name, digits);
        const auto compression =
            number_count(variable) >= kFastCompressionSize ? MAT_COMPRESSION_NONE : MAT_COMPRESSION_ZLIB;
        written = written && Mat_VarWrite(mat.get(), converted.get(), compression) == 0;
    }
    written = written && Mat_Close(mat.release()) == 0 && complaints.first().empty();
    if (!written || !holds_all(draft, variables.size())) {
        throw EnvironmentError(
            "cannot write {}: no space for the temporary file in {}. Delete files in this folder, or set TMPDIR to "
            "another folder",
            file.string(), folder.path().parent_path().string());
    }
    place_file_atomically(with_quick_compression(draft), file);
}

}  // namespace dynlab::inline data_io
