#include "server/render/text/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace plenum::server {

std::size_t TerminalWidth() {
  constexpr long kLeast = 40;
  const char* stated = std::getenv("COLUMNS");
  if (const long columns = stated != nullptr ? std::atol(stated) : 0; columns > 0)
    return static_cast<std::size_t>(std::max(columns, kLeast));
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kAnyWidth;
  return static_cast<std::size_t>(std::max<long>(size.ws_col, kLeast));
}

}  // namespace plenum::server
