// SIGINT as a flag, for work that should stop with the best it has.
#ifndef PLENUM_SERVER_COMMANDS_INTERRUPT_H_
#define PLENUM_SERVER_COMMANDS_INTERRUPT_H_

namespace plenum::server {

// The first SIGINT or SIGTERM sets the flag; a second one ends the program.
void CatchInterrupts();
bool Interrupted();

// For `serve`: blocks both signals in this thread and those it starts, and waits for one.
void BlockInterrupts();
void WaitForInterrupt();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_INTERRUPT_H_
