#include "calibration/names/record_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "calibration/judge/stated.h"
#include "calibration/learn/out_of_reach.h"
#include "calibration/values/specimens.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kInstantsTold = 6, kWildTold = 20;
constexpr double kShiftTold = 2.0;  // in uncertainties of the instants
constexpr std::array<const char*, model::kValveStates> kStates{"hold", "inflate", "deflate"};

// What the commands to a state of the valve have in common, where it is more than was to be
// expected.
std::string SharedInWords(const Bench& bench, const ModelState& model, std::size_t state) {
  double sum_s = 0.0, uncertainties_s = 0.0;
  std::size_t commands = 0;
  for (std::size_t i = 0; i < bench.dataset.runs.size(); ++i) {
    const Run& run = bench.dataset.runs[i];
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      if (static_cast<std::size_t>(run.valve[k].state) != state || !SharesInstant(run, k)) continue;
      ++commands;
      sum_s += MovedBy(run, i, k, model);
      uncertainties_s += InstantUncertainty(run, k);
    }
  }
  if (commands < 2 || std::abs(sum_s) < kShiftTold * uncertainties_s) return {};
  char text[160];
  std::snprintf(
      text, sizeof text,
      "the commands to %s act %.3g ms %s the recorded instants, %.1f times what is stated "
      "of them: the valve or the record of it is %s",
      kStates[state], 1e3 * std::abs(sum_s) / static_cast<double>(commands),
      sum_s > 0.0 ? "after" : "before", std::abs(sum_s) / uncertainties_s,
      sum_s > 0.0 ? "late" : "early");
  return text;
}

// "command 2 of r1 was fitted to be at 0.312 s": of those that no record has.
std::string InstantsInWords(const Bench& bench, const ModelState& state) {
  std::string words;
  std::size_t found = 0;
  for (std::size_t i = 0; i < state.moved_s.size(); ++i) {
    const Run& run = bench.dataset.runs[i];
    for (std::size_t k = 0; k < state.moved_s[i].size(); ++k) {
      if (InstantUncertainty(run, k) != kUnknown || ++found > kInstantsTold) continue;
      char text[64];
      std::snprintf(text, sizeof text, " at %.4g s",
                    run.valve[k].time_s + MovedBy(run, i, k, state));
      words += (words.empty() ? "command " : ", command ") + std::to_string(k + 1) + " of " +
               run.id + text;
    }
  }
  if (found > kInstantsTold) words += " and " + std::to_string(found - kInstantsTold) + " more";
  return words;
}

// "r5 is of c, of which no fit saw a run": empty of other runs.
std::string MeansInWords(const Bench& bench, std::size_t run) {
  std::string numbers;
  for (const Declared number : UntoldNumbers(bench.dataset, bench.data.runs, run))
    (numbers += numbers.empty() ? "" : " and ") += Name(number);
  if (numbers.empty()) return "";
  const Run& held_out = bench.dataset.runs[run];
  return held_out.id + " is" + OfSpecimenInWords(bench.dataset.specimens[held_out.specimen]) +
         ", of which no fit saw a run: it has the mean " + numbers + " of the other specimens";
}

// "r1 at 0.12 s, 0.3 s; r2 at 1 s": the first ones.
std::string WildInWords(const Bench& bench) {
  std::string words;
  std::size_t told = 0, wild = 0;
  for (std::size_t i = 0; i < bench.observed.size(); ++i) {
    const Run& run = bench.dataset.runs[i];
    const std::size_t before = told;
    for (const std::size_t at : bench.observed[i].noise.outliers) {
      if (++wild > kWildTold) continue;
      char text[48];
      std::snprintf(text, sizeof text, " %.6g s", run.t_s[at]);
      words += told == before ? (words.empty() ? "" : "; ") + run.id + " at" : ",";
      words += text;
      ++told;
    }
  }
  return wild > told ? words + " and " + std::to_string(wild - told) + " more" : words;
}

// RMS of the fitted runs' readings, the wild ones among them, by `after`.
double ErrorWithWild(const Bench& bench, const StatedModel& after) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::size_t i : bench.data.runs) {
    const std::vector<double> shown = Shown(bench, OfRun(after, i), i).pressure_pa;
    if (shown.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto add = [&](std::size_t at) {
      const double off_pa = bench.dataset.runs[i].pressure_pa[at] - shown[at];
      squares += off_pa * off_pa;
      ++count;
    };
    for (const std::size_t at : bench.observed[i].signals.front().samples) add(at);
    for (const std::size_t at : bench.observed[i].noise.outliers) add(at);
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, count)));
}

// Which readings were left out as wild, and what they would make of the stated error.
void AddWild(const Bench& bench, Diagnosis& diagnosis) {
  const std::string which = WildInWords(bench);
  if (which.empty()) return;
  char text[96] = "";
  const double all_pa = ErrorWithWild(bench, diagnosis.models.after);
  if (std::isfinite(all_pa))
    std::snprintf(text, sizeof text, "; with them the error is %.3g kPa, where %.3g is stated",
                  all_pa / 1000.0, diagnosis.after.rms_pa / 1000.0);
  diagnosis.warnings.push_back("the wild readings are " + which + text);
}

}  // namespace

void AddWarnings(const Bench& bench, Diagnosis& diagnosis) {
  std::size_t outliers = 0, clipped = 0, staircases = 0;
  for (const ObservedRun& run : bench.observed) {
    outliers += run.noise.outliers.size();
    clipped += run.noise.clipped.size();
    staircases += run.noise.staircase;
  }
  std::vector<std::string>& warnings = diagnosis.warnings;
  if (outliers > 0) warnings.push_back(std::to_string(outliers) + " wild readings were left out");
  AddWild(bench, diagnosis);
  if (clipped > 0)
    warnings.push_back(std::to_string(clipped) +
                       " readings at an end of the sensor's range were left out");
  if (staircases > 0)
    warnings.push_back("the readings' steps are coarser than their noise in " +
                       std::to_string(staircases) + " runs");
  if (diagnosis.slips.empty())
    for (std::string& sentence : OutOfReach(bench.dataset)) warnings.push_back(std::move(sentence));
  for (std::size_t run = 0; run < bench.original.size(); ++run)
    if (IsCopy(bench, run))
      warnings.push_back("the runs " + bench.dataset.runs[bench.original[run]].id + " and " +
                         bench.dataset.runs[run].id + " have the same readings: they count once");
  for (const std::size_t run : bench.held_out)
    if (const std::string numbers = MeansInWords(bench, run); !numbers.empty())
      warnings.push_back(numbers);
  if (const std::string instants = InstantsInWords(bench, diagnosis.models.after.state);
      !instants.empty())
    warnings.push_back("instants that are not known were found in the readings: " + instants);
  for (std::size_t state = 0; state < model::kValveStates; ++state)
    if (std::string shared = SharedInWords(bench, diagnosis.models.after.state, state);
        !shared.empty())
      warnings.push_back(std::move(shared));
  if (bench.data.clocks)
    warnings.push_back(
        "the clocks of readings and valve are off by a part of a sample; each run's was fitted");
  for (const FittedEffect& effect : diagnosis.effects) {
    if (effect.effect.spec->id == "dead_volume")
      warnings.push_back(
          "dead_volume differs from a larger rest_volume only by the declared uncertainties");
  }
}

}  // namespace plenum::calibration
