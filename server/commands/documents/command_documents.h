// `plenum catalog document`: data sheets and recordings of parts, with their files.
#ifndef PLENUM_SERVER_COMMANDS_DOCUMENTS_COMMAND_DOCUMENTS_H_
#define PLENUM_SERVER_COMMANDS_DOCUMENTS_COMMAND_DOCUMENTS_H_

#include "server/commands/command.h"

namespace plenum::server {

// With the commands below it: list, add, get, remove.
Command DocumentCommand();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_DOCUMENTS_COMMAND_DOCUMENTS_H_
