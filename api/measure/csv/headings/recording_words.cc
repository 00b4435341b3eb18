#include "api/measure/csv/headings/recording_words.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "catalog/tables/heading_words.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

// What a word says: a quantity, where it is measured, or that it is none of these.
enum class Means {
  kTime,
  kTimeOrTemperature,
  kDate,
  kRun,
  kSpecimen,
  kValve,
  kFill,  // also a valve on its own
  kVent,
  kPressure,
  kSource,
  kSourcePressure,
  kInlet,
  kInletPressure,
  kTemperature,
  kVolume,
  kFlow,
  kOpening,
  kSetpoint,  // of the source, where a word says so; else another quantity
  kOther      // another quantity: the weather, a reference
};

struct Word {
  std::string_view word;
  Means means;
};
constexpr Word kWords[] = {
    {"t", Means::kTimeOrTemperature},
    {"time", Means::kTime},
    {"times", Means::kTime},
    {"zeit", Means::kTime},
    {"temps", Means::kTime},
    {"timestamp", Means::kTime},
    {"zeitstempel", Means::kTime},
    {"uhrzeit", Means::kTime},
    {"elapsed", Means::kTime},
    {"clock", Means::kTime},
    {"millis", Means::kTime},
    {"micros", Means::kTime},
    {"date", Means::kDate},
    {"datum", Means::kDate},
    {"run", Means::kRun},
    {"trial", Means::kRun},
    {"test", Means::kRun},
    {"experiment", Means::kRun},
    {"versuch", Means::kRun},
    {"lauf", Means::kRun},
    {"messung", Means::kRun},
    {"specimen", Means::kSpecimen},
    {"pruefling", Means::kSpecimen},
    {"valve", Means::kValve},
    {"ventil", Means::kValve},
    {"magnetventil", Means::kValve},
    {"solenoid", Means::kValve},
    {"command", Means::kValve},
    {"cmd", Means::kValve},
    {"phase", Means::kValve},
    {"inflate", Means::kFill},
    {"inflation", Means::kFill},
    {"fill", Means::kFill},
    {"filling", Means::kFill},
    {"einlassventil", Means::kFill},
    {"fuellventil", Means::kFill},
    {"fuellen", Means::kFill},
    {"belueften", Means::kFill},
    {"deflate", Means::kVent},
    {"deflation", Means::kVent},
    {"vent", Means::kVent},
    {"exhaust", Means::kVent},
    {"outlet", Means::kVent},
    {"release", Means::kVent},
    {"auslassventil", Means::kVent},
    {"entlueften", Means::kVent},
    {"entlueftung", Means::kVent},
    {"p", Means::kPressure},
    {"pressure", Means::kPressure},
    {"pres", Means::kPressure},
    {"press", Means::kPressure},
    {"druck", Means::kPressure},
    {"innendruck", Means::kPressure},
    {"istdruck", Means::kPressure},
    {"pression", Means::kPressure},
    {"source", Means::kSource},
    {"supply", Means::kSource},
    {"regulator", Means::kSource},
    {"reservoir", Means::kSource},
    {"tank", Means::kSource},
    {"versorgung", Means::kSource},
    {"quelle", Means::kSource},
    {"psource", Means::kSourcePressure},
    {"psupply", Means::kSourcePressure},
    {"versorgungsdruck", Means::kSourcePressure},
    {"speisedruck", Means::kSourcePressure},
    {"vordruck", Means::kSourcePressure},
    {"inlet", Means::kInlet},
    {"eingang", Means::kInlet},
    {"einlass", Means::kInlet},
    {"upstream", Means::kInlet},
    {"pinlet", Means::kInletPressure},
    {"eingangsdruck", Means::kInletPressure},
    {"temperature", Means::kTemperature},
    {"temperatur", Means::kTemperature},
    {"temp", Means::kTemperature},
    {"volume", Means::kVolume},
    {"volumen", Means::kVolume},
    {"vol", Means::kVolume},
    {"flow", Means::kFlow},
    {"flowrate", Means::kFlow},
    {"durchfluss", Means::kFlow},
    {"volumenstrom", Means::kFlow},
    {"q", Means::kFlow},
    {"opening", Means::kOpening},
    {"oeffnung", Means::kOpening},
    {"oeffnungsgrad", Means::kOpening},
    {"ventiloeffnung", Means::kOpening},
    {"setpoint", Means::kSetpoint},
    {"set", Means::kSetpoint},
    {"target", Means::kSetpoint},
    {"desired", Means::kSetpoint},
    {"reference", Means::kOther},
    {"soll", Means::kSetpoint},
    {"solldruck", Means::kSetpoint},
    {"ambient", Means::kOther},
    {"atmospheric", Means::kOther},
    {"barometric", Means::kOther},
    {"luftdruck", Means::kOther},
    {"error", Means::kOther},
    {"std", Means::kOther},
    {"min", Means::kOther},
    {"max", Means::kOther},
    {"count", Means::kOther},
};

// "ValveState" as "Valve State".
std::string WithoutHumps(std::string_view text) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && is_lower(text[i - 1]) && text[i] >= 'A' && text[i] <= 'Z') words += ' ';
    words += text[i];
  }
  return words;
}

std::set<Means> MeaningsOf(std::string_view words) {
  std::set<Means> meanings;
  const std::string plain = catalog::PlainWords(WithoutHumps(words));
  for (std::string_view word : catalog::Split(plain, ' ')) {
    const std::size_t end = word.find_last_not_of("0123456789");
    word = word.substr(0, end == std::string_view::npos ? 0 : end + 1);  // p1
    const auto* known = std::find_if(std::begin(kWords), std::end(kWords),
                                     [&](const Word& one) { return one.word == word; });
    if (known != std::end(kWords)) meanings.insert(known->means);
  }
  return meanings;
}

std::vector<std::string_view> FieldsOfPressure(const auto& has) {
  const bool source = has(Means::kSource) || has(Means::kSourcePressure);
  const bool inlet = has(Means::kInlet) || has(Means::kInletPressure);
  if ((source && inlet) || has(Means::kVent) || has(Means::kFill)) return {};
  return {source ? kSourcePressureField : inlet ? kInletPressureField : kPressureField};
}

// "Supply setpoint", "Versorgung Solldruck": of the source alone. A set point of nothing else, or
// of another quantity, is no field.
std::vector<std::string_view> FieldsOfSetpoint(std::set<Means> meanings) {
  const bool source =
      meanings.contains(Means::kSource) || meanings.contains(Means::kSourcePressure);
  for (const Means known :
       {Means::kSetpoint, Means::kSource, Means::kSourcePressure, Means::kPressure})
    meanings.erase(known);
  if (!source || !meanings.empty()) return {};
  return {kSetpointField};
}

}  // namespace

const std::vector<std::string>& RecordingFields() {
  static const std::vector<std::string> kFields = {"run",
                                                   "specimen",
                                                   "date",
                                                   "t_s",
                                                   "valve",
                                                   "inflate_valve",
                                                   "deflate_valve",
                                                   "pressure_kpa_gauge",
                                                   "source_pressure_kpa_gauge",
                                                   "inlet_pressure_kpa_gauge",
                                                   "temperature_k",
                                                   "volume_ml",
                                                   "flow_l_per_min_anr",
                                                   "valve_opening",
                                                   "source_setpoint_kpa_gauge"};
  return kFields;
}

bool IsValveField(std::string_view field) {
  return field == kValveField || field == kInflateValveField || field == kDeflateValveField;
}

bool IsPressureField(std::string_view field) {
  return field == kPressureField || field == kSourcePressureField || field == kInletPressureField ||
         field == kSetpointField;
}

bool IsReadingField(std::string_view field) {
  return IsPressureField(field) || field == kTemperatureField || field == kVolumeField ||
         field == kFlowField || field == kOpeningField;
}

std::vector<std::string_view> FieldsNamed(std::string_view words) {
  const std::set<Means> meanings = MeaningsOf(words);
  const auto has = [&](Means one) { return meanings.contains(one); };
  if (meanings.empty() || has(Means::kOther)) return {};
  if (has(Means::kSetpoint)) return FieldsOfSetpoint(meanings);
  const bool pressure =
      has(Means::kPressure) || has(Means::kSourcePressure) || has(Means::kInletPressure);
  if (has(Means::kOpening)) {
    const bool alone = meanings.size() == 1 || (meanings.size() == 2 && has(Means::kValve));
    return alone ? std::vector<std::string_view>{kOpeningField} : std::vector<std::string_view>{};
  }
  const int quantities = int(pressure) + int(has(Means::kTemperature)) + int(has(Means::kVolume)) +
                         int(has(Means::kFlow)) + int(has(Means::kTime)) + int(has(Means::kValve));
  if (quantities > 1) return {};
  if (pressure) return FieldsOfPressure(has);
  if (has(Means::kTime)) return {kTimeField};
  if (has(Means::kTemperature)) return {kTemperatureField};
  if (has(Means::kVolume)) return {kVolumeField};
  if (has(Means::kFlow)) return {kFlowField};
  const bool fill =
      has(Means::kFill) || (has(Means::kValve) && (has(Means::kInlet) || has(Means::kSource)));
  const bool vent = has(Means::kVent);
  if (has(Means::kValve) || fill || vent) {
    if (fill == vent) return {kValveField};
    return {fill ? kInflateValveField : kDeflateValveField};
  }
  if (has(Means::kTimeOrTemperature)) return {kTimeField, kTemperatureField};
  if (has(Means::kRun)) return {kRunField};
  if (has(Means::kSpecimen)) return {kSpecimenField};
  if (has(Means::kDate)) return {kDateField};
  return {};
}

}  // namespace plenum::api
