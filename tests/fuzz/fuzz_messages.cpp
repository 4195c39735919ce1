// The input and output of sandboxes as CBOR, and run results as JSON. Data that can be read are written and read again
// with equal bytes.
#include "course/checks/check_descriptions.h"
#include "course/checks/check_run.h"
#include "course/review/version_description.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "data_io/values/json_values.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

namespace {

template <class T>
void read_again(const std::string& bytes) {
    const std::string written = cbor_of(from_cbor<T>(bytes, sandbox_limits()));
    fuzz::demand(cbor_of(from_cbor<T>(written, sandbox_limits(written.size() + 1))) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text = fuzz::text_of(data, size);
    try {
        switch (fuzz::take_choice(text) % 10) {
            case 0:
                return read_again<GradedRun>(text), 0;
            case 1:
                return read_again<RunJob>(text), 0;
            case 2:
                return read_again<ChecksJob>(text), 0;
            case 3:
                return read_again<CheckResults>(text), 0;
            case 4:
                return read_again<DocumentJob>(text), 0;
            case 5:
                return read_again<UnpackJob>(text), 0;
            case 6:
                return read_again<Unpacked>(text), 0;
            case 7:
                return read_again<VersionJob>(text), 0;
            case 8:
                return read_again<RunRecord>(text), 0;
            default:
                const std::string json = to_json(record_from_json(text));
                fuzz::demand(to_json(record_from_json(json)) == json);
        }
    } catch (const ValueError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
