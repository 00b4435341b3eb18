#include "api/measure/rig/several_chambers.h"

#include <algorithm>
#include <cmath>

#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/rig/measured_line.h"
#include "api/simulate/group_chamber.h"
#include "calibration/values/placed_leaks.h"

namespace plenum::api {
namespace {

using calibration::OneOfSeveral;
using calibration::Run;
using calibration::Several;

constexpr std::size_t kNameCharactersMax = 40;
constexpr double kJunctionMl = 1.0;
constexpr double kIdealUpToPa = 2e6;
// Chambers whose first readings are closer, by this share of the operating pressure, start alike.
constexpr double kAlike = 0.02;

std::string ReadName(Reader& chamber, const Several& several) {
  std::string name = chamber.Text("name");
  const bool taken = std::any_of(several.all.begin(), several.all.end(),
                                 [&](const OneOfSeveral& one) { return one.name == name; });
  if (name.find_first_of("[]:") != std::string::npos || CountCharacters(name) > kNameCharactersMax)
    chamber.Fail("name", "must have at most " + std::to_string(kNameCharactersMax) +
                             " characters, none of them [, ] or :");
  else if (!name.empty() && taken)
    chamber.Fail("name", "must be unique; " + Quoted(name) + " is taken by an earlier chamber");
  return name;
}

// The earlier chamber of that name.
std::size_t ReadFrom(Reader& chamber, const Several& several, std::size_t otherwise) {
  if (!chamber.Has("from")) return otherwise;
  const std::string from = chamber.Text("from");
  std::vector<std::string> names;
  for (std::size_t i = several.first(); i < several.all.size(); ++i) {
    if (several.all[i].name == from) return i;
    names.push_back(several.all[i].name);
  }
  if (!from.empty())
    chamber.Fail("from", names.empty() ? "must be left out of the first chamber, which the rig's "
                                         "line leads to"
                                       : "must be the name of an earlier chamber, " + OneOf(names) +
                                             ", not " + Quoted(from));
  return otherwise;
}

OneOfSeveral ReadOne(Reader chamber, const model::Ambient& ambient, const Several& several) {
  OneOfSeveral one;
  one.name = ReadName(chamber, several);
  chamber.Text("part", "");  // whose numbers stand there by now (rig_parts.h)
  one.chamber = model::Unmirrored(ReadChamber(chamber, ambient, Vacuum::kAllowed));
  const bool valved = several.all.empty();
  one.from = ReadFrom(chamber, several, several.first() > 0 || valved ? 0 : several.all.size() - 1);
  std::vector<MeasuredInRig> measured;
  if (valved && chamber.Has("line"))
    chamber.Fail("line",
                 "must be left out of the first chamber in a row: the rig's line leads to "
                 "it");
  if (chamber.Has("line") || !valved) one.line = ReadPieces(chamber.Object("line"), measured);
  if (!measured.empty()) chamber.Fail("line", "must not measure numbers of parts");
  chamber.Finish();
  return one;
}

OneOfSeveral JunctionOf(Reader& rig, const model::Ambient& ambient) {
  OneOfSeveral junction;
  junction.chamber = {
      .rest_volume_m3 = M3FromMl(rig.Number("junction_volume_ml", {0.01, 1e5}, kJunctionMl)),
      .operating_pressure_pa = ambient.pressure_pa + model::kReferencePressurePa,
      .ambient_pressure_pa = ambient.pressure_pa,
      .volume_curve = {}};
  return junction;
}

// Of the readings before the valve first opens.
double StartOf(Run run, const std::vector<double>& readings) {
  run.pressure_pa = readings;
  return calibration::FirstReading(run);
}

// By how much each chamber starts above the one with the gauge: a chamber without readings, or with
// readings all but alike, starts with it.
void TakeStarts(const ChamberReadings& readings, Run& run) {
  if (run.initial_pressure_pa) return;  // of all
  const double gauge_pa = StartOf(run, readings[run.several.gauge]);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (readings[i].empty()) continue;
    const double above_pa = StartOf(run, readings[i]) - gauge_pa;
    const bool alike = std::abs(above_pa) < kAlike * model::Span(run.several.all[i].chamber);
    run.several.all[i].start_above_pa = alike ? 0.0 : above_pa;
  }
}

}  // namespace

Several ReadSeveral(Reader& rig, const model::Ambient& ambient) {
  Several several;
  if (rig.Has("actuator"))
    rig.Fail("actuator", "must be left out where the rig has chambers: each of them is one");
  const std::string arrangement = rig.Choice("arrangement", {"row", "side_by_side"}, "row");
  if (arrangement == "side_by_side")
    several.all.push_back(JunctionOf(rig, ambient));
  else if (rig.Has("junction_volume_ml"))
    rig.Fail("junction_volume_ml", "is for chambers side by side");
  for (const Element& element : rig.List("chambers", 2, calibration::kChambersMax))
    several.all.push_back(ReadOne(Reader(element, rig.errors()), ambient, several));
  if (several.all.size() <= several.first()) return {};  // not one could be read
  several.gauge = several.first();
  if (!rig.Has("pressure_of")) return several;
  const std::string of = rig.Text("pressure_of");
  std::vector<std::string> names;
  for (std::size_t i = several.first(); i < several.all.size(); ++i) {
    if (several.all[i].name == of) several.gauge = i;
    names.push_back(several.all[i].name);
  }
  if (std::find(names.begin(), names.end(), of) == names.end())
    rig.Fail("pressure_of", "must be the name of a chamber, " + OneOf(names));
  return several;
}

ChamberReadings ReadChamberChannels(
    Reader& channels, const Several& several,
    const std::function<std::vector<double>(Reader&, const std::string&)>& read) {
  ChamberReadings readings(several.all.size());
  channels.Describe("chambers", {{"type", "object"},
                                 {"additionalProperties",
                                  {{"type", Json::array({"array", "null"})},
                                   {"items", {{"type", Json::array({"number", "null"})}}}}}});
  auto chambers = channels.OptionalObject("chambers");
  if (!chambers) return readings;
  if (several.empty()) channels.Fail("chambers", "must be left out: the rig has one chamber");
  for (std::size_t i = several.first(); i < several.all.size(); ++i) {
    const std::string& name = several.all[i].name;
    if (!chambers->Has(name)) continue;
    if (i == several.gauge) chambers->Fail(name, "stands in pressure_kpa_gauge of the run");
    readings[i] = read(*chambers, name);
  }
  chambers->Finish();
  return readings;
}

void CheckSeveral(Reader& owner, const Run& run) {
  if (run.several.empty()) return;
  if (run.volume_imposed) owner.Fail("volume", "must be free where the rig has several chambers");
  double highest_pa = std::max(run.source_pressure_pa, run.initial_pressure_pa.value_or(0.0));
  for (const double pa : run.pressure_pa)
    if (pa > highest_pa) highest_pa = pa;
  if (highest_pa > kIdealUpToPa)
    owner.Fail("rig", "several chambers go up to 2 MPa absolute, where gas is still ideal");
}

std::vector<Run> RunsOfGauges(Run& run, const ChamberReadings& given) {
  std::vector<Run> runs;
  if (run.several.empty()) return runs;
  ChamberReadings readings = given;
  readings[run.several.gauge] = run.pressure_pa;
  run.several.shot = run.id;
  run.specimen = run.several.gauge - run.several.first();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (readings[i].empty() || i == run.several.gauge) continue;
    Run& other = runs.emplace_back(run);
    other.id = run.id + "[" + run.several.all[i].name + "]";
    other.several.gauge = i;
    other.specimen = i - run.several.first();
    other.chamber = run.several.all[i].chamber;
    other.pressure_pa = readings[i];
    for (const auto channel :
         {&calibration::Channels::inlet_pressure_pa, &calibration::Channels::temperature_k,
          &calibration::Channels::volume_m3, &calibration::Channels::flow_m3_per_s})
      (other.channels.*channel).clear();
    if (run.supply != calibration::Supply::kMeasured) other.channels.source_pressure_pa.clear();
    TakeStarts(readings, other);
  }
  TakeStarts(readings, run);
  return runs;
}

}  // namespace plenum::api
