// Text without characters that a terminal or the reader of a log obeys.
#ifndef PLENUM_SERVER_CALL_PRINTABLE_H_
#define PLENUM_SERVER_CALL_PRINTABLE_H_

#include <string>

namespace plenum::server {

// Control characters as JSON writes them, "\u001b": of ASCII but tabs and ends of lines, and those
// of ISO 6429 beyond ASCII, U+0080 to U+009F. A JSON document keeps its meaning.
std::string Printable(const std::string& text);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_PRINTABLE_H_
