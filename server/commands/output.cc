#include "server/commands/output.h"

#include <cstdio>

#include "server/call/printable.h"

namespace plenum::server {

void Print(const std::string& text) {
  const std::string printable = Printable(text);
  std::fwrite(printable.data(), 1, printable.size(), stdout);
}

void Tell(const std::string& line) { std::fprintf(stderr, "%s\n", Printable(line).c_str()); }

}  // namespace plenum::server
