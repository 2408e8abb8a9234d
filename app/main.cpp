#include "app/cli/cli.h"

int main(int argc, char** argv) {
    return si::run_cli(argc, argv);
}
