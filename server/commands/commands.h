// The commands of `plenum`, one file each: command_*.cc.
#ifndef PLENUM_SERVER_COMMANDS_COMMANDS_H_
#define PLENUM_SERVER_COMMANDS_COMMANDS_H_

#include <vector>

#include "server/commands/command.h"

namespace plenum::server {

Command InitCommand();
Command DesignCommand();
Command SweepCommand();
Command VerifyCommand();
Command EvaluateCommand();
Command ExportCommand();
Command SimulateCommand();
Command MapCommand();
Command DiagnoseCommand();
Command ProtocolCommand();
Command CatalogCommand();
Command ServeCommand();
Command WorkerCommand();
Command JobsCommand();
Command TokenCommand();

std::vector<Command> AllCommands();

// The whole command line; gives the exit status.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_COMMANDS_H_
