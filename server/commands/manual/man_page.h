// plenum(1), made of the table of commands, so that the two cannot differ.
#ifndef PLENUM_SERVER_COMMANDS_MANUAL_MAN_PAGE_H_
#define PLENUM_SERVER_COMMANDS_MANUAL_MAN_PAGE_H_

#include <string>
#include <vector>

#include "server/commands/command.h"

namespace plenum::server {

// In the language of man(7): each command with its options and its example.
std::string ManPage(const std::vector<Command>& commands);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_MANUAL_MAN_PAGE_H_
