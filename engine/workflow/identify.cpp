#include "workflow/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/reader.h"
#include "documents/lua_text.h"
#include "numerics/error.h"
#include "workflow/recording.h"

namespace dynlab::inline workflow {
namespace {

/// Pieces of the script; {s} is a suffix that distinguishes the outputs.
constexpr const char* kBegin = R"(-- ---
-- title: Identification report
-- template: identify
-- ---

-- %% id=records echo=false
{load}{inputs}report.value("file", {file})
)";

constexpr const char* kData = R"(
-- %% [markdown]
-- # From `input`{{.value}} to `output{s}`{{.value}}
--
-- ## The data
--
-- `samples{s}`{{.value}} samples of `file`{{.value}}.
--
-- ![Measured output and input](figure:data{s})

-- %% id=data{s} echo=false
local data{s} = {data}
report.value("output{s}", {output})
report.value("samples{s}", data{s}.N, "%d")
report.figure("data{s}", idplot(data{s}):set{{height = 5}}, "")

-- %% id=advice{s} echo=false output=false
advice(data{s})
)";

/// Before the model, where its structure is to be found.
constexpr const char* kSearch = R"(
-- %% [markdown]
-- ## The structure
--
-- Number of poles: `poles{s}`{{.value}}, of zeros: `zeros{s}`{{.value}}, as `srivcstruc` recommends.

-- %% id=structure{s} echo=false
local V{s} = srivcstruc(data{s}, {{poles = {{1, 4}}, zeros = {zeros}, {delay}InitialState = "auto", Offset = "auto"}})
print(V{s}.recommendation)
local best{s} = V{s}.best
report.value("poles{s}", best{s}.poles, "%d")
report.value("zeros{s}", best{s}.zeros, "%d")
)";

constexpr const char* kModel = R"(
-- %% [markdown]
-- ## The model
--
-- {structure}
-- The parameters minimize the difference between the simulated and the measured output. Each parameter is followed by
-- its standard error.

-- %% id=model{s} echo=false
local G{s} = {estimate}
present(G{s})
)";

constexpr const char* kFit = R"(
-- %% [markdown]
-- ## Fit of the simulation
--
-- The simulation uses only the measured input. A fit of 100 % means equal outputs; a fit of 0 % means that the model
-- is no better than the mean output. Noise keeps the fit of a correct model below 100 %.{remark}

-- %% id=fit{s} echo=false output=false
print(string.format("fit to the estimation data: %.2f %%", fit(data{s}, G{s})))
)";

constexpr const char* kCompare = R"(report.figure("fit{s}", compare(data{s}, G{s}):set{{height = 5}}, "")

-- %% [markdown]
-- ![Measured and simulated output](figure:fit{s})
)";

constexpr const char* kCompareBoth = R"(local unseen{s} = {validation}
print(string.format("fit to the validation data: %.2f %%", fit(unseen{s}, G{s})))
report.figure("fit{s}", subplot(2, 1, {{
  compare(data{s}, G{s}):set{{title = "estimation data"}},
  compare(unseen{s}, G{s}):set{{title = "validation data"}}}}):set{{height = 6.4}}, "")

-- %% [markdown]
-- ![Measured and simulated output](figure:fit{s})
)";

constexpr const char* kRest = R"(
-- %% [markdown]
-- ## Residual analysis
--
-- The simulation error (here on the {record} data) should be white and uncorrelated with the input.

-- %% id=residuals{s} echo=false
local errors{s} = resid({tested}{s}, G{s})
if errors{s} then subplot({rows}, 2, {{errors{s}}}):set{{height = {height}}} end
)";

/// Of the model from one input; {m} is that model.
constexpr const char* kResponses = R"(
-- %% [markdown]
-- ## Step and frequency response{from}
--
-- ![Responses with 99 % confidence bands, which are valid if the model structure is correct](figure:responses{s})

-- %% id=responses{s} echo=false
local responses{s} = subplot(1, 3, {{step({m}), bode({m})}})
for panel = 1, 3 do responses{s}:set{{height = 3.8, legend = "none", panel = panel}} end
report.figure("responses{s}", responses{s}, "")
)";

constexpr const char* kNoValidation = R"( No
-- validation data were given. Validate the model on data that were not used for the estimation.)";

std::string structure_of(const IdentifyRequest& request) {
    if (!request.poles)
        return message_text(request.delay ? Message("The model has no delay.")
                                          : Message("The model has an estimated delay."));
    const Message poles = plural(*request.poles, "{} pole", "{} poles"),
                  zeros = plural(request.zeros.value_or(0), "{} zero", "{} zeros");
    if (!request.delay) return message_text(Message("The model has {}, {} and an estimated delay.", poles, zeros));
    return message_text(*request.delay > 0 ? Message("The model has {}, {} and a delay of {} s.", poles, zeros,
                                                     fmt::format("{}", *request.delay))
                                           : Message("The model has {} and {}.", poles, zeros));
}

std::string search_of(const IdentifyRequest& request, const std::string& suffix) {
    using namespace fmt::literals;
    // The search for a delay covers up to a tenth of the data.
    const std::string delay =
        request.delay ? "" : fmt::format("TdMax = (data{0}.t[data{0}.N] - data{0}.t[1])/10, ", suffix);
    const std::string zeros = request.zeros ? fmt::format("{}", *request.zeros) : "{0, 2}";
    return fmt::format(kSearch, "s"_a = suffix, "zeros"_a = zeros, "delay"_a = delay);
}

std::string estimating_call(const IdentifyRequest& request, const std::string& suffix) {
    std::string delay;
    if (request.delay) delay = *request.delay > 0 ? fmt::format("IODelay = {}, ", *request.delay) : "TdMax = 0, ";
    const std::string poles = request.poles ? fmt::format("{}", *request.poles) : fmt::format("best{}.poles", suffix),
                      zeros = request.poles ? fmt::format("{}", request.zeros.value_or(0))
                                            : fmt::format("best{}.zeros", suffix);
    return fmt::format("tfsrivc(data{}, {}, {}, {{{}InitialState = \"auto\", Offset = \"auto\"}})", suffix, poles,
                       zeros, delay);
}

std::string responses_of(const IdentifyRequest& request, const std::string& suffix) {
    using namespace fmt::literals;
    const std::string model = "G" + suffix;
    if (request.inputs.size() == 1) return fmt::format(kResponses, "s"_a = suffix, "m"_a = model, "from"_a = "");
    std::string text;
    for (std::size_t i = 1; i <= request.inputs.size(); ++i)
        text += fmt::format(kResponses, "s"_a = fmt::format("{}_of_{}", suffix, i),
                            "m"_a = fmt::format("{}.channels[{}]", model, i),
                            "from"_a = fmt::format(" from `input_{}`{{.value}}", i));
    return text;
}

/// Names of the inputs, which the text speaks of: all together, and each.
std::string reported_inputs(const std::vector<std::string>& inputs) {
    std::string text =
        fmt::format("report.value(\"input\", {})\n", lua_text(fmt::format("{}", fmt::join(inputs, ", "))));
    for (std::size_t i = 0; inputs.size() > 1 && i < inputs.size(); ++i)
        text += fmt::format("report.value(\"input_{}\", {})\n", i + 1, lua_text(inputs[i]));
    return text;
}

}  // namespace

void IdentifyRequest::validate() const {
    if (outputs.empty()) throw InvalidArgument("give at least one output with --output");
    if (inputs.empty()) throw InvalidArgument("give at least one input with --input");
    for (auto input = inputs.begin(); input != inputs.end(); ++input)
        if (std::find(inputs.begin(), input, *input) != input)
            throw InvalidArgument("the input '{}' is given twice", *input);
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (std::find(inputs.begin(), inputs.end(), *output) != inputs.end())
            throw InvalidArgument("'{}' cannot be both input and output", *output);
        if (std::find(outputs.begin(), output, *output) != output)
            throw InvalidArgument("the output '{}' is given twice", *output);
    }
    if (poles && *poles < 1) throw InvalidArgument("the number of poles must be at least 1, not {}", *poles);
    if (zeros && poles && (*zeros < 0 || *zeros > *poles))
        throw InvalidArgument("the number of zeros must be from 0 to the number of poles, {}, but it is {}", *poles,
                              *zeros);
    if (zeros && *zeros < 0)
        throw InvalidArgument("the number of zeros must be from 0 to the number of poles, but it is {}", *zeros);
    if (!poles && inputs.size() > 1)
        throw InvalidArgument(
            "--poles auto supports only one input, but {} inputs were given; specify the number of poles",
            inputs.size());
    if (!poles && zeros && *zeros > 3)
        throw InvalidArgument(
            "with --poles auto, the number of zeros must be at most 3, but it is {}; specify the number of poles",
            *zeros);
    if (!poles && delay && *delay > 0)
        throw InvalidArgument(
            "--poles auto requires --delay 0 or --delay auto, but the delay is {} s; specify the number of poles, or "
            "change the delay",
            *delay);
    if (delay && !(std::isfinite(*delay) && *delay >= 0))
        throw InvalidArgument("the delay must be nonnegative, but it is {} s", *delay);
    if (Ts && !time.empty()) throw InvalidArgument("give either --Ts or --time, not both");
    if (Ts && !(std::isfinite(*Ts) && *Ts > 0)) throw InvalidArgument("Ts must be positive, but it is {} s", *Ts);
}

std::string identification_script(const IdentifyRequest& request) {
    using namespace fmt::literals;
    request.validate();
    Recording data_set(request.data, request.inputs, request.outputs, request.Ts, request.time, request.time_unit);
    data_set.set_inter_sample(request.moving_input);
    std::optional<Recording> unseen;
    if (!request.validation.empty())
        unseen.emplace(request.validation, request.inputs, request.outputs, request.Ts, request.time,
                       request.time_unit);
    if (unseen) unseen->set_inter_sample(request.moving_input);

    std::string script =
        fmt::format(kBegin, "load"_a = data_set.loading("record") + (unseen ? unseen->loading("validation") : ""),
                    "inputs"_a = reported_inputs(request.inputs), "file"_a = lua_text(request.data));
    for (std::size_t i = 0; i < request.outputs.size(); ++i) {
        const std::string& output = request.outputs[i];
        const std::string suffix = request.outputs.size() == 1 ? "" : fmt::format("_{}", i + 1);
        script += fmt::format(kData, "s"_a = suffix, "data"_a = data_set.data("record", {output}),
                              "output"_a = lua_text(output));
        if (!request.poles) script += search_of(request, suffix);
        script += fmt::format(kModel, "s"_a = suffix, "structure"_a = structure_of(request),
                              "estimate"_a = estimating_call(request, suffix));
        script += fmt::format(kFit, "s"_a = suffix, "remark"_a = unseen ? "" : kNoValidation);
        script += unseen
                      ? fmt::format(kCompareBoth, "s"_a = suffix, "validation"_a = unseen->data("validation", {output}))
                      : fmt::format(kCompare, "s"_a = suffix);
        script +=
            fmt::format(kRest, "s"_a = suffix, "tested"_a = unseen ? "unseen" : "data",
                        "record"_a = unseen ? "validation" : "estimation", "rows"_a = (request.inputs.size() + 2) / 2,
                        "height"_a = 4 * ((request.inputs.size() + 2) / 2));
        script += responses_of(request, suffix);
    }
    return script;
}

}  // namespace dynlab::inline workflow
