#include "scripting/arguments/simulation_options.h"

#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

CompareOptions compare_options(const Options& options, const char* initial_state) {
    return {parse_initial_state(options.text("InitialState", initial_state)),
            parse_offset(options.text("Offset", "auto"))};
}

std::vector<TransferFunction> channels_argument(const Call& call, int index, const char* what) {
    if (index <= call.count())
        if (const Model* model = to_object<Model>(call.state(), index)) return channels_of(*model);
    return {model_argument(call, index, what).G};
}

}  // namespace dynlab::inline scripting
