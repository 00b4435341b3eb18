// Words of a command line that name no command and no option.
#ifndef PLENUM_SERVER_COMMANDS_MANUAL_SUGGESTION_H_
#define PLENUM_SERVER_COMMANDS_MANUAL_SUGGESTION_H_

#include <string>
#include <vector>

#include "server/commands/command.h"

namespace plenum::server {

// Names the first such word and the nearest known one, in one line; empty where all are known.
// `words` are those after the name of the program.
std::string UnknownWord(const std::vector<Command>& commands,
                        const std::vector<std::string>& words);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_MANUAL_SUGGESTION_H_
