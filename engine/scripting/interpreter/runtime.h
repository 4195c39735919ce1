#pragma once
#include <functional>
#include <memory>
#include <string>

#include "documents/percent_script.h"
#include "documents/run_record.h"
#include "scripting/runtime/function_entry.h"
#include "scripting/runtime/prompt_statement.h"
#include "scripting/runtime/run_options.h"
#include "scripting/runtime/script_parts.h"
#include "scripting/runtime/services.h"

namespace dynlab::inline scripting {

struct PlacedMessage;
struct RuntimeContext;

/// One Lua state with dynlab's functions. Scripts get safe libraries only: no files, processes, chunk loading or debug
/// library; text chunks only; memory counted and limited. Globals stay from one run to the next, as a prompt needs.
class Runtime {
  public:
    /// `renderer` draws the figures that scripts save; the caller may use it later to draw the figures of the run
    /// results.
    Runtime(RunOptions options, GnuplotRenderer& renderer);
    ~Runtime();
    Runtime(const Runtime&) = delete;
    Runtime& operator=(const Runtime&) = delete;

    /// Adds functions of a later layer, with the object of this program that they work on, which is
    /// `call.owner<T>()` to them and must outlive the runtime. Call before the first run.
    template <class T>
    void add_functions(FunctionEntries entries, T& owner) {
        add_functions(entries, static_cast<void*>(&owner));
    }
    Services& services();  ///< for programs to fill

    /// Runs the whole script as one chunk, so that its locals span cells; output, figures and times go to the cell at
    /// the line the main chunk has reached. The run results contain an error of the script, with file and line. Throws
    /// Interrupted after Ctrl-C (while an InterruptScope lives), once the Lua state is unwound.
    RunRecord run(const PercentScript& script);
    /// The same for plain Lua text as a single cell "cell-1"; messages use `name` as the file's name.
    RunRecord run_code(const std::string& code, const std::string& name);
    /// Runs Lua code that is part of the program: its expressions are not shown, and no line is checked for a
    /// misreading. Faster than run_code().
    RunRecord run_library(const std::string& code, const std::string& name);
    /// The same in parts, for a document that follows its script: begin_parts(), then every part of `script` in turn.
    /// Each part is a separate chunk with the variables that a prompt's statements share. Parts that have run stay
    /// unchanged when the next one is taken from a later text of the script. Returns everything recorded so far.
    void begin_parts(const PercentScript& script);
    RunRecord run_part(const PercentScript& script, const ScriptPart& part);
    /// A statement of the prompt as a single cell: its values are printed (unless it is silent; a figure is shown
    /// instead), and what it declares local at its outermost level stays visible to later statements.
    RunRecord run_statement(const PromptStatement& statement, const std::string& name);

    /// The script that runs looks at Ctrl-C and its limits at its next step. For signal handlers, on its thread.
    void stop_at_next_step();

    std::size_t peak_memory_bytes() const;
    std::size_t memory_bytes() const;  ///< in use now, after a full collection
    lua_State* state();                ///< for layers that hand values over (answers, prompt)

  private:
    void add_functions(FunctionEntries entries, void* owner);
    void prepare(const PercentScript& script);
    void begin_recording(const PercentScript& script);
    void run_with_variables(const PromptStatement& statement);
    void throw_if_stopped();
    RunRecord run_recorded(const PercentScript& script, const std::function<void()>& work);
    void run_source(const std::string& source, const PromptStatement* statement);
    void run_chunk(const std::string& source, const PromptStatement* statement);
    PlacedMessage error_of_run(int status) const;
    void record_error(PlacedMessage error);
    std::unique_ptr<RuntimeContext> context_;
};

}  // namespace dynlab::inline scripting
