// SIGINT as a flag, for work that should stop with the best it has.
#ifndef PLENUM_SERVER_COMMANDS_INTERRUPT_H_
#define PLENUM_SERVER_COMMANDS_INTERRUPT_H_

#include <chrono>

namespace plenum::server {

// The first SIGINT or SIGTERM sets the flag; a second one ends the program.
void CatchInterrupts();
bool Interrupted();

// For `serve`: blocks both signals in this thread and those it starts, and waits for one.
void BlockInterrupts();
void WaitForInterrupt();
// The same for so long at most; whether one came.
bool WaitForInterrupt(std::chrono::milliseconds time);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_INTERRUPT_H_
