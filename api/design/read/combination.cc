#include "api/design/read/combination.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/joint_rows.h"
#include "api/design/read/selection.h"
#include "api/design/read/stock_volume.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/own_pumps.h"
#include "api/design/read/supply/power.h"
#include "api/design/read/supply/regulation.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "model/physics/storage.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::api {
namespace {

using optimizer::ActuatorGroup;
using optimizer::Choice;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Problem;

constexpr double kRounding = 1e-6;  // relative, of a stated length or volume

bool Near(double a, double b) { return std::abs(a - b) <= kRounding * std::abs(b); }

std::string KpaGauge(double pressure_pa, const Problem& problem) {
  return Decimal(Rounded(optimizer::KpaGauge(problem, pressure_pa))) + " kPa gauge";
}

// "a valve", "tubing"
std::string Piece(Family family) {
  return family == Family::kTubing ? "tubing" : WithArticle(optimizer::Name(family));
}

const std::string& IdOf(const model::Tubing& tube) { return tube.per_metre.id; }
const std::string& IdOf(const auto& part) { return part.basics.id; }

template <typename Part>
const Part* Find(const std::vector<Part>& parts, const Choice* choice) {
  if (choice == nullptr) return nullptr;
  for (const Part& part : parts)
    if (IdOf(part) == choice->id) return &part;
  return nullptr;
}

// The field that says how many pieces of a part of the source there may be; null: always one.
const char* LimitField(Family family) {
  using optimizer::Limits;
  const auto most = optimizer::SpecOf(family).most;
  return most == &Limits::compressors  ? "compressors_max"
         : most == &Limits::batteries  ? "batteries_max"
         : most == &Limits::cylinders  ? "cylinders_max"
         : most == &Limits::co2        ? "co2_max"
         : most == &Limits::reservoirs ? "reservoirs_max"
                                       : nullptr;
}

class Check {
 public:
  Check(const Design& design, const Problem& problem, const std::vector<catalog::Part>& catalogue,
        const std::string& pointer, Errors& errors)
      : design_(design),
        problem_(problem),
        catalogue_(catalogue),
        pointer_(pointer),
        errors_(errors),
        owns_(HaveOwnRegulators(design, problem)) {}

  void Run() {
    const std::size_t before = errors_.size();
    CheckConfiguration();
    for (const Choice& choice : design_.parts) CheckRow(choice);
    CheckMissing();
    CheckRegulation(design_, problem_,
                    [&](const char* place, std::string detail) { Fail(place, std::move(detail)); });
    if (errors_.size() > before) return;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) CheckLine(g);
    CheckSource();
    CheckVolume();
    CheckJointRows(design_, problem_, [&](std::size_t row, const char* field, std::string detail) {
      FailRow(design_.parts[row], field, std::move(detail));
    });
  }

 private:
  void Fail(const std::string& place, std::string detail) {
    errors_.push_back({pointer_ + place, std::move(detail)});
  }
  void FailRow(const Choice& choice, const char* field, std::string detail) {
    Fail("/parts/" + std::to_string(&choice - design_.parts.data()) + field, std::move(detail));
  }
  std::string Is() const { return WithArticle(Name(design_.configuration)) + " design"; }

  // The first row of a family, for a group or (−1) for all.
  const Choice* RowOf(Family family, int group = -1) const {
    for (const Choice& choice : design_.parts)
      if (choice.family == family && choice.group == group) return &choice;
    return nullptr;
  }

  void CheckConfiguration() {
    if (problem_.configurations.contains(design_.configuration)) return;
    std::vector<std::string> names;
    for (const Configuration one : problem_.configurations)
      names.emplace_back(optimizer::Name(one));
    Fail("/configuration", "must be one that supply.configurations asks for, " + OneOf(names) +
                               ", not " + Quoted(optimizer::Name(design_.configuration)));
  }

  void CheckRow(const Choice& choice) {
    if (IsOutside(choice, problem_)) {
      const std::string why = WhyNotOutside(choice, problem_);
      return why.empty() ? void() : FailRow(choice, "/id", why);
    }
    const std::string piece = Piece(choice.family);
    const optimizer::FamilySpec& spec = optimizer::SpecOf(choice.family);
    const bool of_line = spec.in_line || (choice.family == Family::kRegulator && owns_);
    if (!of_line && !spec.joins && !optimizer::IsInSource(problem_, design_.configuration, spec))
      return FailRow(choice, "/family", Is() + " has no " + optimizer::Name(choice.family));
    if (of_line && choice.group < 0)
      return FailRow(choice, "/group",
                     "is required: which group of actuators " + piece + " serves");
    if (!of_line && choice.group >= 0)
      return FailRow(
          choice, "/group",
          "must be left out: " + piece + " serves all groups" + UnlessOwn(choice.family));
    if (choice.family == Family::kFitting && Group(choice).fittings_per_line == 0)
      return FailRow(
          choice, "/family",
          "the lines of " + Group(choice).name + " have no fittings: fittings_per_line is 0");
    if (spec.joins) {
      CheckPart(choice);
      return;
    }
    if (RowOf(choice.family, choice.group) != &choice)
      return FailRow(choice, "/family",
                     "an earlier row is " + piece + (of_line ? " of this group" : "") +
                         " already; a design has one such row");
    if (CheckPart(choice)) spec.in_line ? CheckLineQuantity(choice) : CheckSourceQuantity(choice);
  }

  // Of all groups, or of each.
  std::vector<const Choice*> RegulatorRows() const {
    std::vector<const Choice*> rows;
    for (const Choice& choice : design_.parts)
      if (choice.family == Family::kRegulator) rows.push_back(&choice);
    return rows;
  }

  const ActuatorGroup& Group(const Choice& choice) const { return problem_.groups[choice.group]; }

  // The part is in the catalogue, of its family and allowed.
  bool CheckPart(const Choice& choice) {
    const std::string family = optimizer::Name(choice.family);
    const auto found = std::find_if(catalogue_.begin(), catalogue_.end(),
                                    [&](const auto& part) { return part.id == choice.id; });
    if (found == catalogue_.end() && !IsMadeToMeasure(choice)) {
      std::vector<std::string> ids;
      for (const catalog::Part& part : catalogue_)
        if (part.family == family) ids.push_back(part.id);
      const std::string nearest = Nearest(choice.id, ids);
      FailRow(choice, "/id",
              "no part " + Quoted(choice.id) + " in the catalogue" +
                  (nearest.empty() ? "" : "; nearest " + family + ": " + nearest));
    } else if (found != catalogue_.end() && found->family != family) {
      FailRow(choice, "/id", Quoted(choice.id) + " is a " + found->family + ", not a " + family);
    } else if (problem_.exclude.contains(choice.id)) {
      FailRow(choice, "/id", Quoted(choice.id) + " is one of those that exclude keeps out");
    } else if (!IsAllowed(problem_, choice.family, choice.id)) {
      FailRow(choice, "/id",
              Quoted(choice.id) + " is none of those that require." + family + " asks for");
    } else if (optimizer::Evacuated(problem_) && IsMadeToMeasure(choice)) {
      FailRow(choice, "/id", "a reservoir made to measure is built for pressure, not for a vacuum");
    } else if (optimizer::Evacuated(problem_) && !StandsVacuum(*found)) {
      FailRow(choice, "/id",
              Quoted(choice.id) + " does not stand a vacuum, or its row does not say enough");
    } else if (found != catalogue_.end() && !SuitsVacuumRail(problem_, *found)) {
      FailRow(choice, "/id", Quoted(choice.id) + WhyNotForVacuumRail(*found));
    } else if (found != catalogue_.end() && !SuitsFeed(problem_, *found)) {
      FailRow(choice, "/id", Quoted(choice.id) + WhyNotForFeed(problem_));
    } else if (found != catalogue_.end() && !HasItsPressure(problem_, *found)) {
      FailRow(choice, "/id",
              Quoted(choice.id) + " needs more pressure than the wall has (supply.mains)");
    } else if (found != catalogue_.end() && LacksCheckValve(problem_, *found)) {
      FailRow(choice, "/id",
              Quoted(choice.id) + " lets air back while it is off, and no check valve keeps it");
    } else if (found != catalogue_.end() && !IsAllowed(problem_, choice.family, *found)) {
      FailRow(choice, "/id",
              Quoted(choice.id) + " is no product that one can order, which supply.parts asks for");
    } else {
      return true;
    }
    return false;
  }

  void CheckLineQuantity(const Choice& choice) {
    const ActuatorGroup& group = Group(choice);
    const std::string lines = "the " + std::to_string(group.count) +
                              (group.count == 1 ? " line of " : " lines of ") + group.name;
    double needed = group.count * group.tube_length_m;
    std::string what = "metres of tube for " + lines;
    if (choice.family == Family::kFitting) {
      needed = group.count * group.fittings_per_line;
      what = "fittings for " + lines;
    }
    if (choice.family == Family::kValve) {
      const int channels = Find(problem_.parts.valves, &choice)->channels;
      const int pieces = (group.count + channels - 1) / channels;
      needed = pieces;
      what = "a channel for each of " + lines + ", " + std::to_string(channels) + " a piece";
    }
    if (!Near(choice.quantity, needed))
      FailRow(choice, "/quantity",
              "must be " + Decimal(Rounded(needed)) + " (" + what + "), not " +
                  Decimal(choice.quantity));
  }

  void CheckSourceQuantity(const Choice& choice) {
    const int most = IsMadeToMeasure(choice) ? 1 : optimizer::QuantityMax(problem_, choice.family);
    const char* field = IsMadeToMeasure(choice) ? nullptr : LimitField(choice.family);
    const int feeds = IsMadeToMeasure(choice) ? 1 : optimizer::FeedsOf(problem_, choice.family);
    const double n = choice.quantity / feeds;  // of a feed
    if (n == std::floor(n) && n >= 1 && n <= most) return;
    const std::string limit = field ? std::string(" (limits.") + field + ")" : "";
    FailRow(choice, "/quantity",
            "must be " + PiecesWanted(most, feeds) + limit + ", not " + Decimal(choice.quantity));
  }

  void CheckMissing() {
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
      const ActuatorGroup& group = problem_.groups[g];
      for (const Family family : {Family::kValve, Family::kFitting, Family::kTubing})
        if ((family != Family::kFitting || group.fittings_per_line > 0) && !RowOf(family, g))
          Fail("/parts", Piece(family) + " for group " + group.name + " is missing");
    }
    for (const Family family : optimizer::SourceFamilies(problem_, design_.configuration))
      if (!(family == Family::kRegulator && owns_) && !RowOf(family) &&
          !optimizer::MayLack(design_.configuration, family))
        Fail("/parts", Piece(family) + " is missing: " + Is() + " has one");
  }

  void CheckLine(int g) {
    const model::Parts& parts = problem_.parts;
    const Choice* valve_row = RowOf(Family::kValve, g);
    const Choice* fitting_row = RowOf(Family::kFitting, g);
    if (!fitting_row) return;
    const model::Tubing& tube = *Find(parts.tubing, RowOf(Family::kTubing, g));
    const model::Fitting& fitting = *Find(parts.fittings, fitting_row);
    const model::Valve& valve = *Find(parts.valves, valve_row);
    const auto mm = [](double m) { return Decimal(Rounded(m / kMPerMm)) + " mm"; };
    if (!optimizer::DiametersMate(tube.outer_diameter_m, fitting.tube_outer_diameter_m))
      FailRow(*fitting_row, "/id",
              "takes tube of " + mm(fitting.tube_outer_diameter_m) + ", but " + Quoted(IdOf(tube)) +
                  " has an outer diameter of " + mm(tube.outer_diameter_m));
    if (fitting.thread != valve.port)
      FailRow(*fitting_row, "/id",
              "has the thread " + Quoted(fitting.thread) + ", but the port of " +
                  Quoted(IdOf(valve)) + " is " + Quoted(valve.port));
  }

  // The battery, where there is one, drives the pump.
  void CheckVoltage(const model::Compressor& pump) {
    const Choice* battery_row = RowOf(Family::kBattery);
    if (battery_row == nullptr) return;
    const double pack_v = Find(problem_.parts.batteries, battery_row)->nominal_voltage_v;
    if (!model::VoltageMatches(pack_v, pump.curve.voltage_v))
      FailRow(*battery_row, "/id",
              "has " + Decimal(pack_v) + " V, but " + Quoted(IdOf(pump)) + " runs at " +
                  Decimal(pump.curve.voltage_v) + " V, within 15 %");
  }

  void CheckSource() {
    const model::Parts& parts = problem_.parts;
    if (optimizer::PumpsRail(problem_))
      CheckVoltage(*Find(parts.vacuum_pumps, RowOf(Family::kVacuumPump)));
    if (const auto* pump = Find(optimizer::PumpsOf(problem_, design_.configuration),
                                RowOf(optimizer::PumpFamily(design_.configuration)))) {
      CheckVoltage(*pump);
      if (optimizer::IsDirect(design_.configuration)) CheckDirectValves();
      if (optimizer::IsPumped(design_.configuration)) return;
    }
    if (optimizer::HasTank(design_.configuration)) return CheckTank();
    const auto* cylinder = Find(parts.cylinders, RowOf(Family::kCylinder));
    const double supply_pa = cylinder ? cylinder->fill_pressure_pa
                             : design_.configuration == Configuration::kCo2
                                 ? model::Co2SaturationPressure(problem_.ambient.temperature_k)
                                 : problem_.mains.pressure_pa;
    const std::string supply = "; the supply has " + KpaGauge(supply_pa, problem_);
    for (const Choice* row : RegulatorRows()) {
      const model::Regulator& regulator = *Find(parts.regulators, row);
      if (supply_pa > regulator.inlet_pressure_max_pa)
        FailRow(*row, "/id",
                "stands " + KpaGauge(regulator.inlet_pressure_max_pa, problem_) + " at its inlet" +
                    supply);
      else if (!cylinder && supply_pa < regulator.inlet_pressure_min_pa)
        FailRow(*row, "/id",
                "needs " + KpaGauge(regulator.inlet_pressure_min_pa, problem_) + " at its inlet" +
                    supply);
    }
  }

  // Pumps that are off keep no actuator full, and give valves no pressure to switch with.
  void CheckDirectValves() {
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
      const Choice* row = RowOf(Family::kValve, g);
      const model::Valve& valve = *Find(problem_.parts.valves, row);
      if (!model::Holds(valve.kind))
        FailRow(*row, "/id", "cannot hold: pumps without a reservoir are off while it should");
      else if (valve.pressure_min_pa > problem_.ambient.pressure_pa)
        FailRow(*row, "/id",
                "needs " + KpaGauge(valve.pressure_min_pa, problem_) +
                    " at its inlet to switch, where pumps without a reservoir begin at ambient");
    }
  }

  // Its fill, and without a regulator the valves.
  void CheckTank() {
    const model::Parts& parts = problem_.parts;
    const std::vector<const Choice*> regulators = RegulatorRows();
    const auto* tank = Find(parts.tanks, RowOf(Family::kTank));
    double most_pa = std::min(tank->pressure_max_pa, problem_.tank_fill_max_pa);
    for (const Choice* row : regulators)
      most_pa = std::min(most_pa, Find(parts.regulators, row)->inlet_pressure_max_pa);
    const char* place = "/settings/tank_fill_kpa_gauge";
    const std::optional<double> given = design_.settings.tank_fill_pa;
    if (given && *given > most_pa * (1.0 + kRounding))
      Fail(place, "must be ≤ " + KpaGauge(most_pa, problem_) +
                      ", what the tank and what it feeds stand and the request allows, not " +
                      KpaGauge(*given, problem_));
    if (!regulators.empty()) return;
    if (given && !Near(*given, design_.settings.source_pressure_pa))
      Fail(place, "must be the source pressure, or left out: there is no regulator");
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
      const Choice* row = RowOf(Family::kValve, g);
      if (!model::Holds(Find(parts.valves, row)->kind))
        FailRow(*row, "/id",
                "cannot hold: a tank without a regulator would fill its actuators to "
                "whatever pressure it has");
    }
  }

  void CheckVolume() {
    const char* place = "/settings/reservoir_volume_ml";
    const std::optional<double> given = design_.settings.reservoir_volume_m3;
    const std::string is = given ? ", not " + Decimal(Rounded(MlFromM3(*given))) : "";
    const bool tank = optimizer::HasTank(design_.configuration);
    const Choice* row = RowOf(tank ? Family::kTank : Family::kReservoir);
    const optimizer::Settings& settings = design_.settings;
    if (settings.tank_fill_pa && !tank)
      Fail("/settings/tank_fill_kpa_gauge", "must be left out: " + Is() + " has no tank");
    if (settings.pump_stop_pa && design_.configuration != Configuration::kTankAndPump)
      Fail("/settings/pump_stop_kpa_gauge",
           "must be left out: " + Is() + " fills no tank by pumps");
    if (row == nullptr) {
      if (given) Fail(place, "must be left out: " + Is() + " has no reservoir");
    } else if (!IsMadeToMeasure(*row)) {
      const double stock_m3 = row->quantity * StockOf(problem_, *row).volume_m3;
      if (given && !Near(*given, stock_m3))
        Fail(place, "must be " + Decimal(Rounded(MlFromM3(stock_m3))) + ", the volume of " +
                        Quoted(row->id) + ", or left out" + is);
    } else if (!given || *given < model::kMadeReservoirSmallestM3 * (1.0 - kRounding) ||
               *given > model::kMadeReservoirLargestM3 * (1.0 + kRounding)) {
      Fail(place, std::string(given ? "must be"
                                    : "is required with a reservoir made to measure, a "
                                      "number") +
                      " ≥ " + Decimal(Rounded(MlFromM3(model::kMadeReservoirSmallestM3))) +
                      " and ≤ " + Decimal(Rounded(MlFromM3(model::kMadeReservoirLargestM3))) + is);
    }
  }

  const Design& design_;
  const Problem& problem_;
  const std::vector<catalog::Part>& catalogue_;
  const std::string& pointer_;
  Errors& errors_;
  bool owns_;  // each group has a regulator of its own
};

}  // namespace

void CheckCombination(const Design& design, const Problem& problem,
                      const std::vector<catalog::Part>& catalogue, const std::string& pointer,
                      Errors& errors) {
  Check(design, problem, catalogue, pointer, errors).Run();
}

}  // namespace plenum::api
