// How wide the terminal is that reads what a command prints.
#ifndef PLENUM_SERVER_RENDER_TEXT_TERMINAL_H_
#define PLENUM_SERVER_RENDER_TEXT_TERMINAL_H_

#include <cstddef>
#include <limits>

namespace plenum::server {

inline constexpr std::size_t kAnyWidth = std::numeric_limits<std::size_t>::max();

// Characters of a line: COLUMNS where it is set, else what the terminal at standard output says,
// and kAnyWidth where that is none. At least 40.
std::size_t TerminalWidth();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TERMINAL_H_
