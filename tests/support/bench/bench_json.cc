#include "tests/support/bench/bench_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "tests/support/bench/real_case.h"

namespace plenum::test {
namespace {

using api::Json;

constexpr double kUnitC = 1e-8;
constexpr double kPerMl = 1e6, kPerKpa = 1e-3, kPerMm = 1e3;

double Digits(double value, double unit) { return std::round(value / unit) * unit; }

Json Kpa(const std::vector<double>& pressures_pa) {
  Json list = Json::array();
  for (const double p : pressures_pa) {
    list.push_back(std::isnan(p) ? Json(nullptr) : Json(api::Rounded(Digits(p, 0.1) * kPerKpa)));
  }
  return list;
}

void AddPair(Json& to, const MassElement& e) {
  to["sonic_conductance_dm3_per_s_bar"] = api::Rounded(e.conductance / kUnitC);
  to["critical_ratio"] = api::Rounded(e.critical_ratio);
}

Json LineJson(const BenchRig& rig) {
  Json line;
  AddPair(line, rig.fill);
  if (!rig.one_pair) AddPair(line["exhaust"], rig.exhaust);
  if (rig.tube) {
    line["tube"] = {{"inner_diameter_mm", api::Rounded(rig.tube->inner_diameter_m * kPerMm)},
                    {"length_m", api::Rounded(rig.tube->length_m)}};
  }
  return line;
}

std::string_view SupplyName(BenchSupply supply) {
  static constexpr std::array<std::string_view, 4> kNames = {"none", "regulated", "measured",
                                                             "compressor"};
  return kNames[static_cast<std::size_t>(supply)];
}

Json SupplyJson(const BenchRig& rig) {
  Json supply = {{"kind", SupplyName(rig.supply)}};
  if (rig.supply != BenchSupply::kCompressor) return supply;
  for (const auto& [pressure_pa, free_air] : rig.delivery) {
    supply["curve"].push_back(
        {{"pressure_kpa_gauge", api::Rounded((pressure_pa - rig.ambient_pa) * kPerKpa)},
         {"free_air_l_per_min", api::Rounded(free_air * 6e4)}});
  }
  supply["reservoir_volume_ml"] = api::Rounded(rig.reservoir_m3 * kPerMl);
  return supply;
}

Json UncertaintyJson(const Numbers& sd) {
  Json json = Json::object();
  for (std::size_t n = 0; n < sd.size(); ++n) {
    if (sd[n] == 0.0) continue;
    json[std::string(kNumberNames[n])] =
        std::isinf(sd[n]) ? Json("unknown") : Json(api::Rounded(sd[n]));
  }
  return json;
}

// The true values of the uncertain numbers, in the units in which they are declared; of the source
// pressure, which has one value a run, the factor.
Json TrueNumbers(const BenchCase& bench) {
  const BenchRig& rig = bench.declared;
  const Numbers declared = {rig.rest_volume_m3 * kPerMl,
                            rig.expansion_ratio,
                            rig.operating_gauge_pa * kPerKpa,
                            1.0,
                            rig.fill.conductance / kUnitC,
                            rig.fill.critical_ratio,
                            rig.tube ? rig.tube->inner_diameter_m * kPerMm : 0.0,
                            rig.reservoir_m3 * kPerMl};
  Json json = Json::object();
  for (std::size_t n = 0; n < declared.size(); ++n) {
    if (bench.uncertainty[n] == 0.0) continue;
    json[std::string(kNumberNames[n])] = {{"value", declared[n] * bench.factors[n]},
                                          {"factor", bench.factors[n]}};
  }
  return json;
}

double NoiseRms(const Sensor& sensor, const Record& record) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < record.clean_gauge_pa.size(); ++i) {
    const double reading = record.reading_gauge_pa[i];
    const double noise = reading - record.clean_gauge_pa[i];
    const bool clipped = reading <= sensor.clip_low_pa || reading >= sensor.clip_high_pa;
    if (std::isnan(noise) || clipped || std::abs(noise) > 10.0 * sensor.NoiseFloor()) continue;
    sum += noise * noise;
    ++count;
  }
  return count == 0 ? 0.0 : std::sqrt(sum / count);
}

Json EffectJson(const TrueEffect& effect) {
  Json json = {{"id", effect.id}, {"parameters", Json::object()}};
  if (!effect.law.empty()) json["parameters"]["law"] = effect.law;
  for (const auto& [name, value] : effect.parameters) json["parameters"][name] = value;
  return json;
}

Json SensorJson(const Sensor& sensor) {
  return {{"noise_kpa", sensor.noise_pa * kPerKpa},
          {"noise_floor_kpa", sensor.NoiseFloor() * kPerKpa},
          {"correlated", sensor.correlated_share > 0.0},
          {"quantum_kpa", sensor.quantum_pa * kPerKpa},
          {"clipped", sensor.clip_low_pa > -1e9 || sensor.clip_high_pa < 1e9},
          {"missing", sensor.missing_share > 0.0},
          {"outliers", sensor.outliers},
          {"drift", sensor.zero_drift_pa > 0.0},
          {"clock", sensor.clock_share > 0.0}};
}

}  // namespace

Json RunJson(const BenchCase& bench, const BenchRun& run, const Record& record) {
  Json json = {{"id", run.id}, {"blocked", run.blocked}};
  const BenchSupply supply = bench.declared.supply;
  if (supply == BenchSupply::kRegulated || supply == BenchSupply::kCompressor) {
    json["source_pressure_kpa_gauge"] = api::Rounded(run.source_gauge_pa * kPerKpa);
  }
  if (bench.initial_declared) {
    json["initial"]["pressure_kpa_gauge"] = api::Rounded(run.initial_gauge_pa * kPerKpa);
  }
  for (const MassCommand& c : run.schedule) {
    json["valve"].push_back({{"t_s", api::Rounded(c.time_s)},
                             {"state", c.direction > 0   ? "inflate"
                                       : c.direction < 0 ? "deflate"
                                                         : "hold"}});
  }
  for (const double t_s : record.t_s) json["t_s"].push_back(api::Rounded(t_s));
  json["pressure_kpa_gauge"] = Kpa(record.reading_gauge_pa);
  if (!record.source_gauge_pa.empty()) {
    json["channels"]["source_pressure_kpa_gauge"] = Kpa(record.source_gauge_pa);
  }
  return json;
}

Json MeasurementJson(const BenchCase& bench) {
  char name[32];
  std::snprintf(name, sizeof name, "bench %08llx",
                static_cast<unsigned long long>(bench.seed * 0x9E3779B97F4A7C15ULL >> 32));
  const BenchRig& rig = bench.declared;
  Json json = {{"schema", "measurement/1"}, {"name", name}};
  json["rig"] = {
      {"actuator",
       {{"rest_volume_ml", api::Rounded(rig.rest_volume_m3 * kPerMl)},
        {"expansion_ratio", api::Rounded(rig.expansion_ratio)},
        {"operating_pressure_kpa_gauge", api::Rounded(rig.operating_gauge_pa * kPerKpa)}}},
      {"line", LineJson(rig)},
      {"supply", SupplyJson(rig)},
      {"ambient",
       {{"pressure_kpa_abs", api::Rounded(rig.ambient_pa * kPerKpa)},
        {"temperature_k", rig.ambient_k}}}};
  json["relative_uncertainty"] = UncertaintyJson(bench.uncertainty);
  const std::size_t recorded = bench.runs.size() - (bench.holdout_recorded ? 0 : 1);
  for (std::size_t r = 0; r < recorded; ++r) {
    json["runs"].push_back(RunJson(bench, bench.runs[r], bench.records[r]));
  }
  if (bench.holdout_recorded) json["holdout"] = {bench.runs.back().id};
  return json;
}

Json TruthJson(const BenchCase& bench) {
  Json json = {{"seed", bench.seed},
               {"kind", NameOf(bench.kind)},
               {"supply", SupplyName(bench.declared.supply)},
               {"effects", Json::array()},
               {"visible", bench.visible},
               {"numbers", TrueNumbers(bench)},
               {"sensor", SensorJson(bench.sensor)}};
  if (bench.kind == CaseKind::kReal)
    json["wrong"] = bench.wrong ? Json(kNumberNames[*bench.wrong]) : Json(nullptr);
  for (const TrueEffect& effect : bench.effects) json["effects"].push_back(EffectJson(effect));
  for (std::size_t r = 0; r < bench.runs.size(); ++r) {
    json["runs"].push_back({{"id", bench.runs[r].id},
                            {"held_out", r + 1 == bench.runs.size()},
                            {"blocked", bench.runs[r].blocked},
                            {"samples", bench.records[r].t_s.size()},
                            {"noise_rms_kpa", NoiseRms(bench.sensor, bench.records[r]) * kPerKpa}});
  }
  return json;
}

BenchCase CaseOfTruth(const Json& truth) {
  if (truth.at("kind") == NameOf(CaseKind::kReal))
    return RealOfSeries(truth.at("series"), truth.at("index"));
  const bool tie = truth.at("kind") == NameOf(CaseKind::kTie);
  return tie ? TieOfSeries(truth.at("series"), truth.at("index"))
             : CaseOfSeries(truth.at("series"), truth.at("index"));
}

BenchRun ExperimentFromJson(const BenchCase& bench, const Json& json) {
  BenchRun run;
  run.id = "next";
  run.blocked = json.value("blocked", false);
  run.source_gauge_pa = json.value("source_pressure_kpa_gauge", 0.0) / kPerKpa;
  if (json.contains("initial")) {
    run.initial_gauge_pa = json["initial"].value("pressure_kpa_gauge", 0.0) / kPerKpa;
  }
  for (const Json& command : json.at("valve")) {
    const std::string state = command.at("state");
    run.schedule.push_back({command.at("t_s"), state == "inflate"   ? 1
                                               : state == "deflate" ? -1
                                                                    : 0});
  }
  run.end_s = json.at("t_end_s");
  const double hz = json.at("sample_hz");
  for (int i = 1; i / hz <= run.end_s; ++i) run.t_s.push_back(i / hz);
  if (bench.declared.supply == BenchSupply::kMeasured) {
    const double level_pa = bench.declared.ambient_pa + run.source_gauge_pa;
    run.source_course = [level_pa](double) { return level_pa; };
  }
  return run;
}

}  // namespace plenum::test
