#include "calibration/names/measured_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "calibration/names/wrong_numbers.h"
#include "calibration/values/measured_place.h"
#include "calibration/values/specimens.h"

namespace plenum::calibration {
namespace {

using Kind = MeasuredNumber::Kind;

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

double UncertaintyOf(const Dataset& dataset, Declared number) {
  return dataset.relative_uncertainty[static_cast<std::size_t>(number)];
}

// The declared number that a measured one trades with.
Declared RivalOf(Kind kind) {
  return kind == Kind::kVolume ? Declared::kSonicConductance : Declared::kRestVolume;
}

void OfVerdict(const Diagnosis& diagnosis, std::vector<std::string>& reasons) {
  switch (diagnosis.verdict) {
    case Verdict::kAdequate:
    case Verdict::kExplained:
    case Verdict::kTie:
      return;
    case Verdict::kUnexplained:
      reasons.emplace_back("the readings hold structure that the model does not explain");
      return;
    case Verdict::kUndecided:
      reasons.emplace_back("the diagnosis is undecided");
      return;
  }
}

void OfRivals(const Dataset& dataset, std::vector<std::string>& reasons) {
  std::set<Declared> seen;
  for (const MeasuredNumber& number : dataset.measured) {
    if (number.kind == Kind::kRatio) continue;
    const Declared rival = RivalOf(number.kind);
    const bool has = std::any_of(dataset.runs.begin(), dataset.runs.end(),
                                 [&](const Run& run) { return Has(run, rival); });
    if (!has || UncertaintyOf(dataset, rival) > 0.0 || !seen.insert(rival).second) continue;
    std::string& reason = reasons.emplace_back("relative_uncertainty.");
    reason += Name(rival);
    reason += " is not declared, and " + number.name + " is fixed only as well as it is known";
  }
}

void OfDeclared(const Dataset& dataset, const Diagnosis& diagnosis,
                std::vector<std::string>& reasons) {
  for (const WrongNumber& wrong : diagnosis.numbers)
    reasons.push_back(std::string(Name(wrong.number)) +
                      " of the rig is found wrong: correct it and diagnose again");
  for (const auto& [number, factor, specimen] : diagnosis.fitted) {
    const double uncertainty = UncertaintyOf(dataset, number);
    if (!(uncertainty > 0.0) || uncertainty == kUnknown) continue;
    const double sigmas = std::abs(factor.value - 1.0) / uncertainty;
    if (sigmas > kFarSigmas)
      reasons.push_back(std::string(Name(number)) +
                        (specimen ? OfSpecimenInWords(dataset.specimens[*specimen]) : "") +
                        " had to be moved by " + Percent(std::abs(factor.value - 1.0)) +
                        ", declared to " + Percent(uncertainty));
  }
}

void OfReadings(const Dataset& dataset, const Diagnosis& diagnosis,
                std::vector<std::string>& reasons) {
  for (std::size_t i = 0; i < diagnosis.models.runs.size(); ++i) {
    const Run& run = dataset.runs[i];
    const double share = static_cast<double>(diagnosis.models.runs[i].left_out.size()) /
                         static_cast<double>(run.t_s.size());
    if (share > kLeftOutShare)
      reasons.push_back(Percent(share) + " of the readings of " + run.id +
                        " are wild or at an end of the sensor's range");
  }
}

}  // namespace

void WidenByTied(const Dataset& dataset, std::span<const Contender* const> tied,
                 std::vector<MeasuredEstimate>& measured) {
  if (tied.empty()) return;
  const std::vector<double> first = ValuesOf(dataset, tied.front()->fit.state.measured);
  for (const Contender* one : tied.subspan(1)) {
    const std::vector<double> other = ValuesOf(dataset, one->fit.state.measured);
    for (MeasuredEstimate& estimate : measured) {
      const double apart = std::abs(other[estimate.number] - first[estimate.number]);
      estimate.low = std::min(estimate.low, std::max(0.0, estimate.low - apart));
      estimate.high += apart;
      estimate.deviation = std::hypot(estimate.deviation, apart);
    }
  }
}

std::vector<std::string> WhyNoRevision(const Dataset& dataset, const Diagnosis& diagnosis) {
  if (dataset.measured.empty()) return {"no part of the rig says what to measure"};
  std::vector<std::string> reasons;
  OfVerdict(diagnosis, reasons);
  if (diagnosis.measured.size() < dataset.measured.size())
    reasons.emplace_back("not every number was fitted");
  OfRivals(dataset, reasons);
  OfDeclared(dataset, diagnosis, reasons);
  OfReadings(dataset, diagnosis, reasons);
  return reasons;
}

std::string WhyNotKept(const Dataset& dataset, const MeasuredEstimate& estimate) {
  const MeasuredNumber& number = dataset.measured[estimate.number];
  if (number.kind == Kind::kDelivery && estimate.declared <= 0.0 && estimate.low <= 0.0)
    return "";  // the end of the table, where the pump may well deliver nothing
  if (estimate.at_bound) return "ended at an end of what was searched: the readings do not fix it";
  if (estimate.deviation <= kMostUncertain * estimate.value) return "";
  if (!(estimate.deviation < estimate.value)) return "is not told by this test";
  return "is known to " + Percent(estimate.deviation / estimate.value) +
         " only (one standard deviation), must be " + Percent(kMostUncertain) + " or less";
}

}  // namespace plenum::calibration
