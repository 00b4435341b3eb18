// What a command writes for people and programs.
#ifndef PLENUM_SERVER_COMMANDS_OUTPUT_H_
#define PLENUM_SERVER_COMMANDS_OUTPUT_H_

#include <string>

namespace plenum::server {

// To standard output and, as a line of its own, to standard error; both without what a terminal
// would obey.
void Print(const std::string& text);
void Tell(const std::string& line);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_OUTPUT_H_
