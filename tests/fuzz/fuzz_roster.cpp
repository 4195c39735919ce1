// Rosters, and whose a submission is.
#include "course/intake/owners.h"
#include "course/intake/roster.h"
#include "fuzz/fuzz_input.h"
#include "platform/error.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::text_of(data, size);
    try {
        const Roster roster(fuzz::file_of(text, "roster.csv"));
        for (const Student& student : roster.students()) fuzz::demand(!student.id.empty());
        Submission submission;
        submission.name = text.substr(0, 60);
        const Owners::Found found = Owners(roster.students()).find(submission);
        fuzz::demand(found.anybody() == found.error_reason.empty());
        for (const std::size_t place : found.students) fuzz::demand(place < roster.students().size());
    } catch (const EnvironmentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
