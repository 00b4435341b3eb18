// How the command ends, and the exception that carries bad input to its end.
#ifndef PLENUM_SERVER_COMMANDS_EXIT_STATUS_H_
#define PLENUM_SERVER_COMMANDS_EXIT_STATUS_H_

#include <stdexcept>
#include <string>

namespace plenum::server {

inline constexpr int kAnswered = 0;  // an infeasible problem is an answer
inline constexpr int kBadInput = 2;
inline constexpr int kFault = 3;
inline constexpr int kInterrupted = 130;

// What the user gave cannot be used; the message has one line per error.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_EXIT_STATUS_H_
