// ASCII letters in lower case; all other bytes, those of UTF-8 too, as they are.
#ifndef PLENUM_SERVER_CALL_LOWER_CASE_H_
#define PLENUM_SERVER_CALL_LOWER_CASE_H_

#include <string>

namespace plenum::server {

inline std::string LowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return text;
}

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_LOWER_CASE_H_
