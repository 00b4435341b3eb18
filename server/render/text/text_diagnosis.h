// diagnosis/1 for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_DIAGNOSIS_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_DIAGNOSIS_H_

#include <string>
#include <vector>

#include "api/json/json.h"

namespace plenum::server {

// The verdict in one sentence, the error before and after, the effects with their intervals, the
// candidates, the residual by phase; for a tie the run that decides it, for what no effect explains
// where it lives.
std::string DiagnosisText(const api::Json& answer);

// A number's name with its unit, as Spoken takes it; "1" is none.
std::string WithUnit(std::string name, const std::string& unit);

// Pieces of it, also for the report. A parameter's name as words and its unit: "sonic conductance",
// "dm³/(s·bar)".
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit Spoken(const std::string& parameter);
// What each piece of the actuator has of its own, in cells: specimen, runs, number, value,
// interval, unit. And how far they differ, in words; empty of less than two.
std::vector<std::vector<std::string>> SpecimenRows(const api::Json& answer);
std::string SpreadInWords(const api::Json& answer);
// The name of a wrong number as words, with the specimen that has it for itself; and its unit.
NameAndUnit WrongNumberSpoken(const api::Json& number);
// "creep + leak (porous)"; "none" for no effect.
std::string EffectsText(const api::Json& effects, const api::Json& laws);
// "explained", in capital letters first: the verdict and what it means.
std::string VerdictText(const api::Json& answer);
// Whether a test was passed: "yes", "no"; "not tested" where null, for want of time.
std::string PassedText(const api::Json& passed);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_DIAGNOSIS_H_
