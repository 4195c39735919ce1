#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

void add_texts(DigestStream& digest, const std::vector<std::string>& texts) {
    const std::size_t count = texts.size();
    digest.add(&count, sizeof count);
    for (const std::string& text : texts) digest.add_part(text);
}

template <class Numbers>
void add_numbers(DigestStream& digest, const Numbers& numbers) {
    const Index size[] = {numbers.rows(), numbers.cols()};
    digest.add(size, sizeof size).add(numbers.data(), sizeof(double) * static_cast<std::size_t>(numbers.size()));
}

}  // namespace

std::size_t Userdata<IdData>::outside_bytes(const IdData& data) {
    std::size_t numbers = 0;
    for (const Experiment& experiment : data.experiments)
        numbers += static_cast<std::size_t>(experiment.y.size() + experiment.u.size() + experiment.t.size() +
                                            experiment.r.size());
    return numbers * sizeof(double) + data.experiments.size() * sizeof(Experiment);
}

Digest Userdata<IdData>::digest(const IdData& data) {
    DigestStream digest;
    const auto& [experiments, Ts, hold, input_names, output_names, input_units, output_units, time_unit] = data;
    digest.add(&Ts, sizeof Ts).add(&hold, sizeof hold).add_part(time_unit);
    for (const auto* texts : {&input_names, &output_names, &input_units, &output_units}) add_texts(digest, *texts);
    for (const auto& [y, u, t, start_time, name, r] : experiments) {
        digest.add(&start_time, sizeof start_time).add_part(name);
        add_numbers(digest, y);
        add_numbers(digest, u);
        add_numbers(digest, t);
        add_numbers(digest, r);
    }
    return digest.digest();
}

const IdData& signals_of_argument(const Call& call, int index, ArgumentName what) {
    const IdData* data = index <= call.count() ? to_object<IdData>(call.state(), index) : nullptr;
    if (data == nullptr) wrong_argument(call.state(), index, what, with_article(Userdata<IdData>::type.name));
    return *data;
}

template <>
Access<IdData>& object_argument<IdData>(const Call& call, int index, ArgumentName what) {
    const IdData& data = signals_of_argument(call, index, what);
    if (data.output_count() > 0) return data;
    throw InvalidArgument(
        "{} must have an output, but these data contain only inputs; sim, simsd and idplot accept data without outputs",
        argument_label(index, what));
}

int give_data(const Call& call, IdData data) {
    push_object(call.state(), std::move(data));
    return 1;
}

}  // namespace dynlab::inline scripting
