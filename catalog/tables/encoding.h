// The encoding of a table: found where its bytes leave no doubt, asked for where they do.
#ifndef PLENUM_CATALOG_TABLES_ENCODING_H_
#define PLENUM_CATALOG_TABLES_ENCODING_H_

#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

// "utf-8", "utf-16le", "utf-16be", "windows-1252" (Latin-1 with its printed extension).
const std::vector<std::string>& EncodingNames();

struct Decoded {
  std::string text;      // UTF-8 without byte-order mark, with lines that end in LF or CRLF
  std::string encoding;  // empty: see question
  std::string question;  // what cannot be told from the bytes
  std::string error;     // the bytes are not what they say
};

// `given` is one of the names, or empty: then
//   a byte-order mark decides; without one, NUL in every second byte is UTF-16, well-formed UTF-8
//   is UTF-8, and other bytes are windows-1252 if all that are above 127 stand for what western and
//   central European encodings share (ä ö ü ß é ç …) or for technical signs that stand where such
//   signs stand (µ ² ³ ° ± · € –). Any other byte may be another letter in another encoding
//   (0xE8: è or č): the question shows where.
Decoded Decode(std::string_view bytes, std::string_view given);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_ENCODING_H_
