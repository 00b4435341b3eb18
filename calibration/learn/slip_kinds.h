// Slips of the pen that a record may hold, each by the name under which a user settles it and with
// what undoes it.
//
// A name as it is written: "psi", or "psi:r1,r3" where only those runs have the slip; upper case,
// spaces and hyphens are read as lower case and underscores. Pairs of runs: "exchanged:r1,r3".
#ifndef PLENUM_CALIBRATION_LEARN_SLIP_KINDS_H_
#define PLENUM_CALIBRATION_LEARN_SLIP_KINDS_H_

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// Of one run each.
struct SlipKind {
  const char* name;
  const char* what;  // "… fit far better if <what>"
  std::function<void(Run&)> undo;
  bool another_unit = false;  // of the readings
};
std::span<const SlipKind> SlipKinds();
inline constexpr const char* kAllMs = "all_ms";

// Of two runs that have each other's.
struct ExchangeKind {
  const char* name;
  const char* what;  // "… fit far better with their <what> exchanged"
  std::function<void(Run&, Run&)> undo;
};
std::span<const ExchangeKind> ExchangeKinds();

// Whether no pressure of the run is below vacuum by more than a sensor may be off.
bool IsPossible(const Run& run);

// The record is as it was meant, whatever it looks like.
inline constexpr std::string_view kAsWritten = "as_written";

// Undoes the slip in the record, or notes that there is none. Empty, or why the name says nothing.
std::string Settle(std::string_view assumption, Dataset& dataset);

// What is assumed, in words: "the readings are in bar, not kPa".
std::string InWords(std::string_view assumption);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_SLIP_KINDS_H_
