#include "api/measure/fitted/bottles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/fitted/fitted_numbers.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::MeasuredNumber;

constexpr double kBothSides95 = 1.959964;

double VolumeMl(const Dataset& dataset, const BottleRuns& bottle) {
  return dataset.runs[bottle.runs.front()].chamber.rest_volume_m3 / kM3PerMl;
}

std::string BottleInWords(const Dataset& dataset, const BottleRuns& bottle) {
  return (bottle.bottle.empty() ? "the unnamed bottle" : bottle.bottle) + " (" +
         Decimal(Rounded(VolumeMl(dataset, bottle))) + " ml)";
}

std::string FourDigits(const Json& number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number.get<double>());
  return text;
}

bool IsSameNumber(const Json& a, const Json& b) {
  return a.at("part") == b.at("part") && a.at("number") == b.at("number") &&
         a.value("pressure_kpa_gauge", Json()) == b.value("pressure_kpa_gauge", Json());
}

bool IsKnown(const Json& row) {
  return row.at("refused").is_null() && row.at("uncertainty").is_number();
}

bool Agree(const Json& a, const Json& b) {
  const double one = a.at("fitted").get<double>(), other = b.at("fitted").get<double>();
  return std::abs(one - other) <=
         kBothSides95 * std::hypot(one * a.at("uncertainty").get<double>(),
                                   other * b.at("uncertainty").get<double>());
}

}  // namespace

std::vector<BottleRuns> RunsByBottle(const Dataset& dataset) {
  using Kind = MeasuredNumber::Kind;
  const bool rests_on_volume = std::any_of(
      dataset.measured.begin(), dataset.measured.end(), [](const MeasuredNumber& number) {
        return number.kind == Kind::kConductance || number.kind == Kind::kDelivery;
      });
  if (!rests_on_volume || dataset.specimens.size() < 2u) return {};
  std::vector<BottleRuns> bottles;
  for (const std::string& name : dataset.specimens) bottles.push_back({name, {}});
  for (std::size_t i = 0; i < dataset.runs.size(); ++i)
    bottles[dataset.runs[i].specimen].runs.push_back(i);
  std::erase_if(bottles, [](const BottleRuns& bottle) { return bottle.runs.empty(); });
  std::stable_sort(bottles.begin(), bottles.end(), [](const BottleRuns& a, const BottleRuns& b) {
    return a.runs.size() > b.runs.size();
  });
  return bottles;
}

Dataset OnlyRuns(Dataset dataset, const std::vector<std::size_t>& runs) {
  std::vector<calibration::Run> kept;
  kept.reserve(runs.size());
  for (const std::size_t run : runs) {
    kept.push_back(std::move(dataset.runs[run]));
    kept.back().specimen = 0;
  }
  dataset.runs = std::move(kept);
  dataset.specimens.clear();
  std::erase_if(dataset.holdout, [&](const std::string& id) {
    return std::none_of(dataset.runs.begin(), dataset.runs.end(),
                        [&](const calibration::Run& run) { return run.id == id; });
  });
  return dataset;
}

Json OnlyRuns(Json measurement, const std::vector<std::size_t>& runs) {
  Json kept = Json::array(), ids = Json::array();
  for (const std::size_t run : runs) {
    kept.push_back(measurement.at("runs").at(run));
    kept.back().erase("specimen");
    ids.push_back(kept.back().at("id"));
  }
  measurement["runs"] = std::move(kept);
  if (!measurement.contains("holdout")) return measurement;
  Json holdout = Json::array();
  for (const Json& id : measurement["holdout"])
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) holdout.push_back(id);
  measurement["holdout"] = std::move(holdout);
  return measurement;
}

Json CompareBottles(const Json& first, const BottleRuns& first_runs, const Json& other,
                    const BottleRuns& other_runs, const Dataset& dataset, Json& refused) {
  Json numbers = Json::array(), ids = Json::array();
  for (const std::size_t run : other_runs.runs) ids.push_back(dataset.runs[run].id);
  const std::string both =
      BottleInWords(dataset, first_runs) + " and " + BottleInWords(dataset, other_runs);
  for (const Json& reason : other.at("measured_refused"))
    refused.push_back("the runs of " + BottleInWords(dataset, other_runs) +
                      " confirm nothing: " + reason.get<std::string>());
  std::string off;
  for (const Json& row : first.at("measured")) {
    const auto match = std::find_if(other.at("measured").begin(), other.at("measured").end(),
                                    [&](const Json& one) { return IsSameNumber(row, one); });
    if (match == other.at("measured").end() || !IsKnown(row) || !IsKnown(*match)) continue;
    const bool agrees = Agree(row, *match);
    const Json pressure = row.value("pressure_kpa_gauge", Json());
    numbers.push_back({{"number", row.at("number")},
                       {"pressure_kpa_gauge", pressure},
                       {"fitted", match->at("fitted")},
                       {"uncertainty", match->at("uncertainty")},
                       {"agrees", agrees}});
    if (agrees || !off.empty()) continue;
    off = row.at("number").get<std::string>() +
          (pressure.is_number() ? " at " + Decimal(pressure.get<double>()) + " kPa" : "") + " is " +
          FourDigits(row.at("fitted")) + " and " + FourDigits(match->at("fitted")) + " by " + both +
          ", more apart than the uncertainties of both: one of these volumes is wrong";
  }
  if (!off.empty()) refused.push_back(off);
  return {{"specimen", SpecimenName(other_runs.bottle)},
          {"runs", std::move(ids)},
          {"rest_volume_ml", Number(VolumeMl(dataset, other_runs))},
          {"verdict", other.at("verdict")},
          {"numbers", std::move(numbers)}};
}

}  // namespace plenum::api
