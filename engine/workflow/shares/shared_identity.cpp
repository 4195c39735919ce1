#include "workflow/shares/shared_identity.h"

#include <filesystem>

#include "numerics/linalg/processor_level.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"

namespace dynlab::inline workflow {

std::string shared_identity() {
    namespace fs = std::filesystem;
    DigestStream identity;
    identity.add_part(processor_level());
    const fs::path program = running_program();
    for (const fs::path& file : programs_beside(program)) identity.add_file(file);
    if (const auto libraries = library_folder_of(program)) identity.add_part(digest_of_folder(*libraries).hex());
    for (const char* folder : {"lessons", "data", "report_templates"})
        if (const fs::path shared = shared_folder() / folder; fs::exists(shared))
            identity.add_part(digest_of_folder(shared).hex());
    return identity.digest().hex();
}

}  // namespace dynlab::inline workflow
