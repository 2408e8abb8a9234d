#include "app/base/notes.h"
#include "app/cli/cli.h"

int main(int argc, char** argv) {
    si::open_standard_descriptors();
    return si::run_cli(argc, argv);
}
