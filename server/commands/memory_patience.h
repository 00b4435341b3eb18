// What happens where there is no memory.
#ifndef PLENUM_SERVER_COMMANDS_MEMORY_PATIENCE_H_
#define PLENUM_SERVER_COMMANDS_MEMORY_PATIENCE_H_

namespace plenum::server {

// From now on `new` tries again for a tenth of a second before it throws std::bad_alloc, in every
// thread. Destructors of JSON documents ask for memory (nlohmann-json 3.11) and may not throw: one
// refusal of a moment would end the program.
void WaitForMemory();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_MEMORY_PATIENCE_H_
