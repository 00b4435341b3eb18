#include "server/call/printable.h"

#include <cstdio>

namespace plenum::server {

std::string Printable(const std::string& text) {
  std::string printable;
  printable.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto at = [&](std::size_t place) {
      return place < text.size() ? static_cast<unsigned char>(text[place]) : 0u;
    };
    const unsigned byte = at(i), next = at(i + 1);
    const bool wide = byte == 0xc2 && next >= 0x80 && next < 0xa0;  // in UTF-8
    const bool ends_line = byte == '\n' || byte == '\t' || (byte == '\r' && next == '\n');
    if (!wide && (ends_line || (byte >= ' ' && byte != 0x7f))) {
      printable += text[i];
      continue;
    }
    char escaped[8];
    std::snprintf(escaped, sizeof escaped, "\\u%04x", wide ? next : byte);
    printable += escaped;
    i += wide ? 1 : 0;
  }
  return printable;
}

}  // namespace plenum::server
