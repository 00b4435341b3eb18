#include "server/commands/commands.h"

int main(int argc, char** argv) { return plenum::server::RunCommandLine(argc, argv); }
