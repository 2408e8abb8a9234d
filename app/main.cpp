#include "app/base/notes.h"
#include "app/cli/cli.h"

int main(int argc, char** argv) {
    si::open_standard_descriptors();
    si::survive_file_limits();
    return si::run_cli(argc, argv);
}
