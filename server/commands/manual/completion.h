// Completion of the command line by bash, made of the table of commands.
#ifndef PLENUM_SERVER_COMMANDS_MANUAL_COMPLETION_H_
#define PLENUM_SERVER_COMMANDS_MANUAL_COMPLETION_H_

#include <string>
#include <vector>

#include "server/commands/command.h"

namespace plenum::server {

// A script that completes commands, options, and the values of options that take certain words
// alone; where nothing fits bash completes names of files.
std::string BashCompletion(const std::vector<Command>& commands);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_MANUAL_COMPLETION_H_
