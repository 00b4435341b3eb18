// How far a search is, on one line of the terminal: for command_design.cc, command_sweep.cc and
// ../command_diagnose.cc.
#ifndef PLENUM_SERVER_COMMANDS_DESIGNS_PROGRESS_LINE_H_
#define PLENUM_SERVER_COMMANDS_DESIGNS_PROGRESS_LINE_H_

#include <unistd.h>

#include <cstdio>
#include <string>

#include "server/call/printable.h"

namespace plenum::server {

// The line is written over and over; nothing is written where errors go to a file.
class ProgressLine {
 public:
  void Show(const std::string& text) {
    if (!terminal_) return;
    std::fprintf(stderr, "\r\x1b[K%s", Printable(text).c_str());
    std::fflush(stderr);
  }
  void Show(double share, const std::string& what) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%3.0f %%  ", 100.0 * share);
    Show(percent + what);
  }
  ~ProgressLine() {
    if (terminal_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_DESIGNS_PROGRESS_LINE_H_
