#include "api/measure/words/effect_words.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "api/json/units.h"
#include "api/json/words.h"
#include "calibration/values/placed_leaks.h"
#include "model/flow/iso6358.h"

namespace plenum::api {
namespace {

using Values = std::vector<double>;

constexpr double kDm3PerSBar = 1e-8;  // m³/(s·Pa)

std::string Seconds(double s) {
  return s < 1.0 ? Significant(1e3 * s) + " ms" : Significant(s) + " s";
}
std::string KpaText(double pa) { return Significant(pa / 1e3) + " kPa"; }
std::string PercentText(double share) { return Significant(100.0 * share, 2) + " %"; }
std::string Conductance(double m3_per_s_pa) {
  return Significant(m3_per_s_pa / kDm3PerSBar) + " dm³/(s·bar)";
}

double AirOf(const Scale& scale, double pressure_pa) {
  return model::StandardVolume(model::Content(scale.chamber, pressure_pa) -
                                   model::Content(scale.chamber, scale.ambient.pressure_pa),
                               scale.ambient.temperature_k);
}

// Flow out of the actuator at the highest reading, m³/s ANR.
double LeakFlow(const std::string& law, const Values& values, const Scale& scale) {
  const double ambient_pa = scale.ambient.pressure_pa, p = scale.highest_pa;
  if (law == "orifice")
    return values[0] * p * std::sqrt(model::kReferenceTemperatureK / scale.ambient.temperature_k) *
           model::FlowFunction(ambient_pa / p, values[1]);
  const double squares = p * p - ambient_pa * ambient_pa;
  if (law == "laminar") return values[0] * squares / (2.0 * model::kReferencePressurePa);
  const double viscous = values[0], inertial = values[1];
  const double kg_per_s =
      inertial > 0.0
          ? 2.0 * squares / (viscous + std::sqrt(viscous * viscous + 4.0 * inertial * squares))
          : squares / viscous;
  return kg_per_s / model::kReferenceDensityKgPerM3;
}

// Of an evacuated actuator: what comes in at its operating pressure, and how much that is of what
// was taken out.
std::string LeakIn(const std::string& law, const Values& values, const Scale& scale) {
  const double ambient_pa = scale.ambient.pressure_pa;
  const double deep_pa = scale.chamber.operating_pressure_pa;
  Scale mirrored = scale;  // the same flow from the surroundings into it
  mirrored.ambient.pressure_pa = deep_pa;
  mirrored.highest_pa = ambient_pa;
  const double flow = LeakFlow(law, values, mirrored), taken = -AirOf(scale, deep_pa);
  const double per_s = flow / taken;
  return "it lets in " + Significant(6e4 * flow) + " L/min at " +
         Significant((deep_pa - ambient_pa) / 1e3) + " kPa gauge, " +
         (per_s > 1.0 / 60.0 ? PercentText(per_s) + " of a stroke each second"
                             : PercentText(60.0 * per_s) + " of a stroke each minute");
}

std::string Leak(const std::string& law, const Values& values, const Scale& scale) {
  if (model::Shrinks(scale.chamber)) return LeakIn(law, values, scale);
  if (!(scale.highest_pa > scale.ambient.pressure_pa)) return "it leaks";
  const double flow = LeakFlow(law, values, scale);
  std::string text = "it leaks " + Significant(6e4 * flow) + " L/min at " +
                     Significant((scale.highest_pa - scale.ambient.pressure_pa) / 1e3) +
                     " kPa gauge";
  const double fill = AirOf(scale, scale.highest_pa);
  if (!(fill > 0.0)) return text;
  const double per_s = flow / fill;
  return text + ", " +
         (per_s > 1.0 / 60.0 ? PercentText(per_s) + " of a fill each second"
                             : PercentText(60.0 * per_s) + " of a fill each minute");
}

std::string DeadVolume(const Values& values, const Scale& scale) {
  const double rest_m3 = model::Volume(scale.chamber, scale.ambient.pressure_pa);
  return "it has " + Significant(1e6 * values[0]) + " mL that were not declared, " +
         PercentText(values[0] / rest_m3) + " of the volume at rest";
}

// x + a·x·(x − 1) + s·sin(2πx)/(2π)
std::string Compliance(const Values& values, const Scale& scale) {
  if (!scale.chamber.volume_curve.empty())
    return "its volume follows the pressure on another curve than the declared one";
  const auto at = [&](double x) {
    constexpr double kTurn = 6.283185307179586;
    return x + values[0] * x * (x - 1.0) + values[1] * std::sin(kTurn * x) / kTurn;
  };
  const bool shrinks = model::Shrinks(scale.chamber);
  return std::string("its volume does not ") + (shrinks ? "shrink" : "grow") +
         " evenly: " + PercentText(at(0.25)) + " of the " +
         (shrinks ? "contraction" : "expansion") + " at a quarter of the operating pressure, " +
         PercentText(at(0.5)) + " at half, " + PercentText(at(0.75)) + " at three quarters";
}

std::string More(double factor, const char* more, const char* less) {
  return PercentText(std::abs(factor - 1.0)) + (factor >= 1.0 ? more : less);
}

using Sentence = std::function<std::string(const Values&, const Scale&)>;

using Sentences = std::map<std::string, Sentence>;

const Sentences& OfTheChamber() {
  static const Sentences sentences{
      {"dead_volume", DeadVolume},
      {"nonlinear_compliance", Compliance},
      {"creep",
       [](const Values& v, const Scale& scale) {
         return std::string("its wall creeps: it ") +
                (model::Shrinks(scale.chamber) ? "shrinks" : "expands") + " by " +
                PercentText(v[0]) + " more than at once, with a time constant of " + Seconds(v[1]);
       }},
      {"inertia",
       [](const Values& v, const Scale&) {
         return "its wall and load swing at " + Significant(v[0] / 6.283185307179586) +
                " Hz, damped to " + Significant(v[1]) + " of what would stop them swinging";
       }},
      {"heat_transfer",
       [](const Values& v, const Scale&) {
         return "its gas warms as it is filled and cools as it is emptied, and takes the wall's "
                "temperature with a time constant of " +
                Seconds(v[0]);
       }},
      {"wall_heat",
       [](const Values& v, const Scale&) {
         return "its gas warms its wall, which holds " + Significant(v[1]) +
                " times the heat of the gas, with a time constant of " + Seconds(v[0]);
       }},
      {"outgassing",
       [](const Values& v, const Scale&) {
         return "gas comes out of its walls or pockets: " + Significant(6e7 * v[0]) +
                " mL/min at the start, less and less with a time constant of " + Seconds(v[1]);
       }},
      {"hysteresis", [](const Values& v, const Scale&) {
         return "its volume on the way up and on the way down lies " + KpaText(2.0 * v[0]) +
                " apart";
       }}};
  return sentences;
}

const Sentences& OfTheLine() {
  static const Sentences sentences{
      {"valve_delay",
       [](const Values& v, const Scale&) { return "the valve acts " + Seconds(v[0]) + " late"; }},
      {"valve_ramp",
       [](const Values& v, const Scale&) {
         return "the valve takes " + Seconds(v[0]) + " to open and to close";
       }},
      {"supply_droop",
       [](const Values& v, const Scale&) {
         return "the source sags, like " + Significant(1e6 * v[0]) + " mL refilled through " +
                Conductance(v[1]);
       }},
      {"exhaust_restriction",
       [](const Values& v, const Scale&) {
         return "the way out has one more restriction, of " + Conductance(v[0]);
       }},
      {"directional_conductance",
       [](const Values& v, const Scale&) {
         return "its line passes " + More(v[0], " more", " less") +
                " on the way in than the declared elements do";
       }},
      {"cracking_pressure",
       [](const Values& v, const Scale&) {
         return "its line passes nothing below a difference of " + KpaText(v[0]);
       }},
      {"line_dynamics", [](const Values& v, const Scale&) {
         return "the gas in its tube moves as in " + Significant(v[0]) + " m of " +
                Significant(1e3 * v[1]) + " mm bore";
       }}};
  return sentences;
}

const Sentences& OfTheSensor() {
  static const Sentences sentences{
      {"sensor_lag",
       [](const Values& v, const Scale&) {
         return "the sensor follows with a time constant of " + Seconds(v[0]);
       }},
      {"sensor_offset",
       [](const Values& v, const Scale&) {
         return "the sensor reads " + KpaText(std::abs(v[0])) +
                (v[0] >= 0.0 ? " too high" : " too low");
       }},
      {"sensor_gain", [](const Values& v, const Scale&) {
         return "the sensor reads " + More(v[0], " too much", " too little");
       }}};
  return sentences;
}

}  // namespace

Scale ScaleOf(const calibration::Dataset& dataset, const model::Effect& effect) {
  Scale scale;
  if (dataset.runs.empty()) return scale;
  const auto& runs = dataset.runs;
  scale.ambient = runs.front().ambient;
  scale.chamber = runs.front().chamber;
  const std::optional<std::size_t> chamber = calibration::ChamberOfLeak(*effect.spec);
  if (chamber) scale.chamber = calibration::ChamberOf(runs.front(), *chamber);
  const bool gauged = std::any_of(runs.begin(), runs.end(), [&](const calibration::Run& run) {
    return chamber && run.specimen == *chamber;
  });
  for (const calibration::Run& run : runs)
    if (!gauged || run.specimen == *chamber)
      for (const double pa : run.pressure_pa) scale.highest_pa = std::max(scale.highest_pa, pa);
  return scale;
}

std::string EffectInWords(const model::Effect& effect, const Scale& scale) {
  if (effect.parameters.size() < effect.spec->parameters.size()) return "";
  const std::string id(calibration::WithoutChamber(*effect.spec).id);
  if (id == "leak") return Leak(std::string(effect.spec->law), effect.parameters, scale);
  for (const Sentences* sentences : {&OfTheChamber(), &OfTheLine(), &OfTheSensor()})
    if (const auto found = sentences->find(id); found != sentences->end())
      return found->second(effect.parameters, scale);
  return "";
}

std::string NumberInWords(const std::string& name, double declared, double fitted,
                          const std::string& unit) {
  std::string text = name;
  std::replace(text.begin(), text.end(), '_', ' ');
  static const std::map<std::string, std::string> kUnits{{"kpa_gauge", " kPa gauge"},
                                                         {"kpa_abs", " kPa absolute"},
                                                         {"kpa", " kPa"},
                                                         {"K", " K"},
                                                         {"ml", " mL"},
                                                         {"dm3_per_s_bar", " dm³/(s·bar)"},
                                                         {"mm", " mm"}};
  const auto found = kUnits.find(unit);
  const std::string in = found == kUnits.end() ? "" : found->second;
  text += " is " + Significant(fitted) + in;
  if (!(declared > 0.0)) return text + ", declared are " + Significant(declared) + in;
  return text + ", " + More(fitted / declared, " more", " less") + " than declared";
}

}  // namespace plenum::api
