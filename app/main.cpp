#include "app/base/notes.h"
#include "app/cli/cli.h"
#include "app/context/large_pages.h"

int main(int argc, char** argv) {
    si::restart_with_large_pages(argv);
    si::open_standard_descriptors();
    si::survive_file_limits();
    return si::run_cli(argc, argv);
}
