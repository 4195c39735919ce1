// Answers of students as the checks read them: what can be pushed is an answer again.
#include "figures/gnuplot_renderer.h"
#include "fuzz/fuzz_input.h"
#include "numerics/error.h"
#include "scripting/answers/answer_value.h"
#include "scripting/interpreter/runtime.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static GnuplotRenderer renderer;
    static Runtime runtime({}, renderer);
    lua_State* const L = runtime.state();
    const int top = lua_gettop(L);
    try {
        push_answer_value(L, fuzz::text_of(data, size));
        const AnswerValue again = answer_value(L, top + 1);
        push_answer_value(L, again.json);
        fuzz::demand(answer_value(L, top + 2).json == again.json);
    } catch (const InvalidArgument& error) {
        fuzz::demand(*error.what() != '\0');
    }
    lua_settop(L, top);
    return 0;
}
