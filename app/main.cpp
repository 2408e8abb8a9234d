#include "app/base/notes.h"
#include "app/cli/cli.h"
#include "renderer/scenes/foreign_jobs.h"

int main(int argc, char** argv) {
    si::foreign_child_main(argc, argv, si::foreign_jobs());
    si::open_standard_descriptors();
    si::survive_file_limits();
    return si::run_cli(argc, argv);
}
