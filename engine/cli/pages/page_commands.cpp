#include "cli/commands.h"

namespace dynlab::inline cli {

Commands page_commands() {
    return {add_site, add_preview, add_app, add_kernel, add_doctor, add_complete, add_man_pages};
}

}  // namespace dynlab::inline cli
