#include "scripting/arguments/loop_arguments.h"

#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

LoopController controller_at(const Call& call, int index) {
    lua_State* L = call.state();
    if (lua_type(L, index) == LUA_TNUMBER)
        return {TransferFunction(Vector::Constant(1, lua_tonumber(L, index)), Vector::Ones(1))};
    const Model* model = to_object<Model>(L, index);
    if (model == nullptr)
        throw InvalidArgument("{} must be {}, but {} was given", Message("the controller"),
                              Message("a model, such as 2 + 1/s or tf({2, -1.9}, {1, -1}, Ts)"), given_value(L, index));
    if (!model->single_channel())
        throw InvalidArgument(
            "the controller must have one input (reference minus output) and one output, but this model has {} and {}",
            plural(model->inputs(), "{} input", "{} inputs"), plural(model->outputs, "{} output", "{} outputs"));
    return {model->G};
}

Index computing_delay_of(const Options& options) {
    return options.size("ComputingDelay", 0);
}

LoopKnowledge loop_knowledge(const Options& options) {
    LoopKnowledge known;
    options.read(known);
    if (!options.has("controller")) {
        if (options.has("ComputingDelay"))
            throw InvalidArgument(
                "option 'ComputingDelay', the delay of the controller, requires option 'controller'; specify "
                "'controller', or omit 'ComputingDelay'");
        return known;
    }
    known.controller = controller_at(options.call(), options.push("controller"));
    known.controller->computing_delay = computing_delay_of(options);
    known.find_computing_delay = !options.has("ComputingDelay");
    return known;
}

}  // namespace dynlab::inline scripting
